"""Functions of `std::atomic` objects as what they do in the one thread that serves a rebec.

What another thread does to such an object is listed where that thread is begun.
"""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader, Exchange
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.types.cpp_conversions import converted_to, operands
from rebsync.reverse.bodies.types.cpp_widths import check
from rebsync.reverse.models.building import binary
from rebsync.reverse.syntax.cpp_tree import text_of

_ORDER = ("std::memory_order", "memory_order")
_ADDS = {"fetch_add": "+", "fetch_sub": "-"}


def call(
    reader: CppExpressionReader, node: Node, target: Node, name: str, arguments: Sequence[Node]
) -> m.Expression | None:
    """`x.load()`, `x.exchange(e)`, `x.fetch_add(e)`, as a statement `x.store(e)`; else None."""
    given = [a for a in arguments if not text_of(a).startswith(_ORDER)]
    place = resolve(reader.scope, target)
    if not isinstance(place, Variable) or place.type is None or place.type.dimensions:
        return None
    if name == "load" and not given:
        return reader.read(target)
    if len(given) != 1 or name not in ("store", "exchange", *_ADDS):
        return None
    is_statement = node.parent is not None and node.parent.type == "expression_statement"
    if not is_statement and name != "store":
        return reader.inlined(node, Exchange(target, given[0], _ADDS.get(name, "")), ())
    if not is_statement:
        return None
    span, written = reader.cpp.span(node), reader.read(target)
    if name in _ADDS:
        check(reader, node, _ADDS[name], (target, given[0]))
        sides = operands(reader.scope, _ADDS[name], written, reader.read(given[0]))
        return m.Assign("=", written, converted_to(reader.scope, binary(*sides), place), span)
    return m.Assign("=", written, reader.stored(given[0], place), span)
