"""Casts of C++ as what they do to the values of the model."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync import precedence
from rebsync.reverse.bodies import cpp_texts
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.types.cpp_conversions import as_number, converted_to, type_in
from rebsync.reverse.bodies.types.cpp_types import type_of
from rebsync.reverse.bodies.types.cpp_widths import check_stored, place_of
from rebsync.reverse.models.building import bare, tight
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.syntax.cpp_tree import text_of
from rebsync.static.types import BOOLEAN, INT, is_boolean, is_integer


def cast(reader: CppExpressionReader, to: Node, operand: Node, node: Node) -> m.Expression:
    """A value that is converted by a cast of whatever kind."""
    plain = type_of(to)
    if plain is not None and not plain.dimensions and not reader.scope.open:
        inner = reader.operand(operand, precedence.CAST)
        given = type_in(reader.scope, inner)
        if given is None or is_boolean(given) == (plain == BOOLEAN):
            return m.Cast(plain, inner, reader.cpp.span(node))
    kept = reader.scope.carried(to)
    if kept is None or kept.type.dimensions:
        raise reader.unread(node, f'the model has no type "{text_of(to)}"')
    if (kept.bits or kept.wide) and not reader.scope.open:
        raise reader.unread(node, f'"{text_of(to)}" is none of the model\'s types')
    if kept.type == BOOLEAN:
        return reader.condition(operand)
    value = reader.read(operand)
    cpp_texts.check_stored(reader, operand, value, place_of("", kept))
    if kept.type == TEXT:
        return value
    check_stored(reader, operand, value, place_of("", kept))
    of = type_in(reader.scope, value)
    if of is not None and is_boolean(of):
        return as_number(reader.scope, value)
    if of is not None and kept.bits:
        return converted_to(reader.scope, value, Variable("", kept.type, kept.bits))
    if of is not None and is_integer(of) and (_holds(value, of, kept.type) or kept.why):
        return value
    return m.Cast(kept.type, tight(value, precedence.CAST), reader.cpp.span(node))


def _holds(value: m.Expression, of: m.Type, type_: m.Type) -> bool:
    """Whether a value is in the range of a type: what is computed is as wide as an int."""
    stored = isinstance(bare(value), m.Name | m.Member | m.Index | m.Cast | m.IntLiteral)
    return of == type_ and (type_ == INT or stored)
