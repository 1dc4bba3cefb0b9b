"""Which local variables and parameters of two bodies are the same, whatever they are called."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import TypeAlias

from rebsync import model as m
from rebsync.roundtrip.diff.operands import Callable

Locals: TypeAlias = dict[int, str]
Mapped: TypeAlias = tuple[Locals, Locals]


def local_variables(body: m.Block | None) -> Iterator[tuple[m.Declarator, m.Type]]:
    """The local variables of a body in the order of the text."""
    for node in m.walk(body) if body is not None else ():
        declaration: object = None
        if isinstance(node, m.Local):
            declaration = node.declaration
        elif isinstance(node, m.For):
            declaration = node.initial
        if isinstance(declaration, m.Declaration):
            yield from ((d, declaration.type) for d in declaration.declarators)


def parameters_as_one(
    left: Callable, right: Callable, pairs: list[tuple[m.Parameter, m.Parameter]]
) -> Mapped:
    """Tokens of the parameters: one for each pair, and one for each that has no partner."""
    paired = {id(r): x for x, r in pairs}
    first = {id(p): f"%{p.name}" for p in left.parameters}
    second = {
        id(p): first[id(paired[id(p)])] if id(p) in paired else f"%{p.name}'"
        for p in right.parameters
    }
    return first, second


def by_order(left: m.Block | None, right: m.Block | None) -> Mapped:
    """The first local of one body is the first of the other, and so on."""
    first, second = (
        {id(d): f"%{i}" for i, (d, _) in enumerate(local_variables(body))} for body in (left, right)
    )
    return first, second


def by_name(left: m.Block | None, right: m.Block | None) -> Mapped:
    """Locals of one name are the same."""
    return _named(left), _named(right)


def _named(body: m.Block | None) -> Locals:
    seen: Counter[str] = Counter()
    found: Locals = {}
    for declarator, _ in local_variables(body):
        seen[declarator.name] += 1
        found[id(declarator)] = f"%{declarator.name}.{seen[declarator.name]}"
    return found


def by_type(body: m.Block | None) -> Locals:
    """All locals of one type look the same: to find those that are declared in one place."""
    return {id(d): f"%{type_}" for d, type_ in local_variables(body)}


def by_pairs(
    left: m.Block | None,
    right: m.Block | None,
    pairs: list[tuple[m.Declarator, m.Declarator]],
) -> Mapped:
    """Locals that are a pair are the same, others are not."""
    first = {id(d): f"%{i}" for i, (d, _) in enumerate(local_variables(left))}
    second = {id(d): f"%{i}'" for i, (d, _) in enumerate(local_variables(right))}
    second |= {id(r): first[id(x)] for x, r in pairs}
    return first, second
