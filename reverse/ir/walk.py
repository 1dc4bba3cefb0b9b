"""Going through the intermediate form: the parts of each node, in the order of evaluation."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from functools import cache
from operator import attrgetter
from typing import TypeAlias, get_args

from rebsync.reverse.ir import calls as c
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function, Program

Node: TypeAlias = (
    e.Expression
    | e.Spread
    | e.FormatPiece
    | e.Capture
    | s.Statement
    | s.CallArgument
    | s.Callee
    | s.Case
    | s.Handler
)
_NODES: frozenset[type] = frozenset(
    kind
    for module in (c, e, s)
    for kind in vars(module).values()
    if isinstance(kind, type) and kind.__module__ == module.__name__
)


def parts(node: Node | Function) -> list[Node]:
    """The nodes directly within a node."""
    found: list[Node] = []
    for get in _getters(type(node)):  # type: ignore[arg-type]
        _add(get(node), found)
    return found


def walk(node: Node | Function | s.Body) -> Iterator[Node]:
    """A node and all within it, each before its parts; of a function or body, what is within."""
    waiting: list[Node] = []
    if isinstance(node, Function):
        waiting = parts(node)
    else:
        _add(node, waiting)
    waiting.reverse()
    while waiting:
        current = waiting.pop()
        yield current
        inner = parts(current)
        inner.reverse()
        waiting += inner


def walk_all(program: Program) -> Iterator[tuple[str, Node]]:
    """All nodes of the functions of a program, each with the name of its function."""
    for name in program.functions:
        yield from ((name, node) for node in walk(program.function(name)))


def statements(body: s.Body) -> Iterator[s.Statement]:
    """All statements of a body, those within others included; none of closures."""
    return (n for n in walk(body) if isinstance(n, STATEMENTS))  # type: ignore[misc]


def _add(value: object, found: list[Node]) -> None:
    """Adds the nodes that a field holds. Which kinds there are is closed: none is extended."""
    kind = type(value)
    if kind in _NODES:
        found.append(value)  # type: ignore[arg-type]
    elif kind is tuple:
        for inner in value:  # type: ignore[attr-defined]
            _add(inner, found)


@cache
def _getters(kind: type) -> tuple[attrgetter[object], ...]:
    """What reads the fields of a kind of node that may hold nodes."""
    names = [f.name for f in dataclasses.fields(kind) if f.name not in _NO_NODES]
    return tuple(map(attrgetter, names))


_NO_NODES = frozenset({"place", "type", "name", "dynamic", "reason"})

SIMPLE: tuple[type, ...] = get_args(s.Simple)
STRUCTURED: tuple[type, ...] = get_args(s.Structured)
STATEMENTS = SIMPLE + STRUCTURED
