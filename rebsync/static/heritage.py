"""Which class descends from which: parents, loops, and an order with ancestors first."""

from __future__ import annotations

from dataclasses import field

from rebsync.model import Interface, ReactiveClass
from rebsync.records import dataclass
from rebsync.source import NOWHERE, Span
from rebsync.static.facts import Facts
from rebsync.static.scope import check_name

Declared = ReactiveClass | Interface


@dataclass(slots=True)
class Heritage:
    """The parents of one declaration that can be used; `partial` when others cannot."""

    declaration: Declared
    parents: list[Declared] = field(default_factory=list)
    partial: bool = False


def declare_classes(facts: Facts, declarations: tuple[Declared, ...]) -> None:
    """Enters all classes and interfaces by name; of two with one name the first counts."""
    for declaration in declarations:
        name, span = declaration.name, declaration.name_span
        check_name(facts, name, span)
        first = facts.declared.get(name)
        if first is None:
            facts.declared[name] = declaration
        else:
            place = ((first.name_span, "first declared here"),)
            facts.error("RS207", span, f'"{name}" is already declared', related=place)


def ancestors_first(facts: Facts, declarations: tuple[Declared, ...]) -> list[Heritage]:
    """Every declaration after its parents; loops are reported and cut."""
    heritages = {id(d): _heritage(facts, d) for d in declarations}
    order: list[Heritage] = []
    done: set[int] = set()
    for declaration in declarations:
        _visit(facts, heritages[id(declaration)], heritages, done, order)
    return order


def _visit(
    facts: Facts,
    start: Heritage,
    heritages: dict[int, Heritage],
    done: set[int],
    order: list[Heritage],
) -> None:
    path: list[tuple[Heritage, int]] = [(start, 0)]
    on_path = {id(start.declaration)}
    while path:
        heritage, at = path.pop()
        key = id(heritage.declaration)
        if key in done:
            continue
        if at == len(heritage.parents):
            done.add(key)
            on_path.discard(key)
            order.append(heritage)
            continue
        parent = heritage.parents[at]
        if id(parent) in on_path:
            _report_loop(facts, heritage, parent, [h for h, _ in path])
            continue_at = at
        else:
            continue_at = at + 1
        path.append((heritage, continue_at))
        if continue_at > at and id(parent) not in done:
            on_path.add(id(parent))
            path.append((heritages[id(parent)], 0))


def _report_loop(facts: Facts, last: Heritage, first: Declared, path: list[Heritage]) -> None:
    names = [h.declaration.name for h in path] + [last.declaration.name]
    loop = [*names[names.index(first.name) :], first.name]
    facts.error(
        "RS406",
        last.declaration.name_span,
        f'"{last.declaration.name}" descends from itself: {" extends ".join(loop)}',
    )
    last.parents.remove(first)
    last.partial = True


def _heritage(facts: Facts, declaration: Declared) -> Heritage:
    heritage = Heritage(declaration)
    for name, span, wanted in _named(declaration):
        parent = facts.declared.get(name)
        if isinstance(parent, wanted):
            if not any(p is parent for p in heritage.parents):
                heritage.parents.append(parent)
            continue
        heritage.partial = True
        kind = "class" if wanted is ReactiveClass else "interface"
        if parent is None:
            legal = [n for n, d in facts.declared.items() if isinstance(d, wanted)]
            facts.unknown("RS201", span, f'unknown {kind} "{name}"', name, legal, certain=True)
        else:
            message = f'"{name}" is a class' if kind == "interface" else f'"{name}" is an interface'
            facts.error("RS407", span, message, _kind_hint(declaration, wanted))
    return heritage


def _kind_hint(declaration: Declared, wanted: type[Declared]) -> str:
    if wanted is ReactiveClass:
        return "a class implements an interface: write implements"
    if isinstance(declaration, Interface):
        return "an interface extends interfaces only"
    return "a class extends one class: write extends"


def _named(declaration: Declared) -> list[tuple[str, Span, type[Declared]]]:
    """The parents as written, with their places and the kind that each must be of."""
    named: list[tuple[str, Span, type[Declared]]] = []
    if isinstance(declaration, ReactiveClass):
        names, spans = declaration.implements, declaration.implements_spans
        if declaration.extends is not None:
            named.append((declaration.extends, declaration.extends_span, ReactiveClass))
    else:
        names, spans = declaration.extends, declaration.extends_spans
    for i, name in enumerate(names):
        named.append((name, spans[i] if i < len(spans) else NOWHERE, Interface))
    return named
