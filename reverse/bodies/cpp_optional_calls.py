"""Functions of `std::optional` objects that only look: whether a value is there, and which."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.cpp_places import HELD, resolve
from rebsync.reverse.bodies.scope import Record
from rebsync.reverse.models.building import chosen, is_calm
from rebsync.reverse.syntax.cpp_tree import text_of


def call(
    reader: CppExpressionReader, node: Node, target: Node, name: str, arguments: Sequence[Node]
) -> m.Expression | None:
    """`x.has_value()`, `x.value()` and `x.value_or(e)`; None for other calls."""
    optional = resolve(reader.scope, target)
    if not isinstance(optional, Record) or HELD not in optional.fields:
        return None
    held, span = optional.fields[HELD], reader.cpp.span(node)
    there = m.Name(optional.there, span)
    match name, len(arguments):
        case "has_value", 0:
            return there
        case "value", 0:
            form = reader.scope.form
            if form is None or form.looked_up(reader.cpp, node):
                why = f'"{text_of(node)}" throws where there is no value'
                raise reader.unread(node, why, "ask it before, or use value_or")
            return m.Name(held.name, span)
        case "value_or", 1:
            other = reader.stored(arguments[0], held)
            if not is_calm(other):
                raise reader.unread(arguments[0], "this is evaluated in any case", "use a local")
            return chosen(there, m.Name(held.name), other)
        case _:
            return None
