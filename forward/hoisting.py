"""Locals that C++ and Python must have declared before the model declares them."""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.model import (
    Assign,
    Declaration,
    Declarator,
    Local,
    Name,
    Node,
    Switch,
    walk,
)
from rebsync.static import Analysis


def read_declarations(nodes: Iterable[Node], analysis: Analysis) -> set[int]:
    """The ids of the declarations whose values are used, not only written, below the nodes."""
    read: set[int] = set()
    for node in nodes:
        only_written: set[int] = set()
        for inner in walk(node):
            match inner:
                case Assign(operator="=", target=Name() as target):
                    only_written.add(id(target))
                case Name() if id(inner) not in only_written:
                    symbol = analysis.symbols.get(id(inner))
                    read.add(id(getattr(symbol, "declaration", None)))
                case _:
                    pass
    return read


def crossing_locals(switch: Switch, analysis: Analysis) -> list[tuple[Declaration, Declarator]]:
    """The locals of a case that later cases use: C++ needs their declaration before the cases."""
    found: dict[int, tuple[Declaration, Declarator]] = {}
    declared: dict[int, tuple[Declaration, Declarator]] = {}
    for case in switch.cases:
        for node in (n for s in case.statements for n in walk(s) if isinstance(n, Name)):
            key = id(getattr(analysis.symbols.get(id(node)), "declaration", None))
            if key in declared:
                found[key] = declared[key]
        own = [s.declaration for s in case.statements if isinstance(s, Local)]
        declared |= {
            id(d): (declaration, d) for declaration in own for d in declaration.declarators
        }
    return list(found.values())


def hoisted(nodes: Iterable[Node], analysis: Analysis) -> set[int]:
    """The ids of all declarators that stand before the `switch` in C++."""
    switches = (n for node in nodes for n in walk(node) if isinstance(n, Switch))
    return {id(d) for s in switches for _, d in crossing_locals(s, analysis)}
