"""Named constants of C++: what their types make of the values that stand behind them."""

from __future__ import annotations

from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.bodies.types.cpp_types import Carried, is_time
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import bare
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_tree import named
from rebsync.static.constants import constant
from rebsync.static.types import BOOLEAN, BYTE, DOUBLE, INT, SHORT, is_integer

_BITS = {BYTE: 7, SHORT: 15, INT: 31}
_EXACT = 2**24  # whole numbers up to here are numbers of a `float`


def constant_named(
    reader: CppExpressionReader, node: Node, at: CppExpressionReader, value: Node
) -> m.Expression:
    """What a constant is that has a name; `at` can name what its value can.

    What is not known of it is told where it is named: its value may be in another file.
    """
    try:
        return _of_constant(replace(at, inlines=None), value)
    except Unread as unread:
        raise type(unread)(reader.cpp.span(node), unread.why, unread.hint) from None


def _of_constant(reader: CppExpressionReader, value: Node) -> m.Expression:
    """What a constant is whose value is written so; `reader` can name what the value can.

    Unread: its type holds another number, or the model has no number of that type.
    """
    type_ = _declared(value)
    if reader.scope.open and value.type in ("string_literal", "concatenated_string"):
        return reader.read(value)
    kept = reader.scope.carried(type_) if type_ is not None and not is_time(type_) else None
    is_one = type_ is None or (kept is not None and not kept.type.dimensions)
    if is_one and value.type == "initializer_list" and len(named(value)) == 1:
        (value,) = named(value)
    if kept is None or kept.type.dimensions:
        read = reader.read(value)
        if kept is None and type_ is not None and not is_time(type_) and constant(read) is not None:
            raise reader.unread(value, "what the constant's type makes of this is not known")
        return read
    if kept.type == BOOLEAN:
        return reader.condition(value)
    read = reader.read(value)
    made = _whole(reader, read, kept) if is_integer(kept.type) else _decimal(reader, read, kept)
    if made is None:
        raise reader.unread(value, "the constant's type makes another number of this")
    return made


def _whole(reader: CppExpressionReader, read: m.Expression, kept: Carried) -> m.Expression | None:
    number, of = constant(read), type_in(reader.scope, read)
    if number is None:
        return read if of == kept.type == INT and not kept.bits else None
    unsigned = kept.bits or kept.wide in (32, 64)
    high = 2 ** (kept.bits or _BITS[kept.type]) - 1
    low = 0 if unsigned else -high - 1
    is_kept = isinstance(number, int) and not isinstance(number, bool) and low <= number <= high
    return read if is_kept else None


def _decimal(reader: CppExpressionReader, read: m.Expression, kept: Carried) -> m.Expression | None:
    of, number = type_in(reader.scope, read), constant(read)
    if of == kept.type:
        return read
    if isinstance(number, int) and not isinstance(number, bool) and abs(number) <= _EXACT:
        literal = m.FloatLiteral(f"{abs(number)}.0{'d' if kept.type == DOUBLE else ''}", read.span)
        return literal if number >= 0 else m.Unary("-", literal, read.span)
    match bare(read):
        case m.FloatLiteral(text) if kept.type != DOUBLE:
            return m.FloatLiteral(text.rstrip("dD"), read.span)
        case _:
            return None


def _declared(value: Node) -> Node | None:
    """The type that the declaration of a constant names; None for a macro and for `auto`."""
    above = climb(value, lambda n: n.type in ("declaration", "field_declaration"))
    type_ = above.child_by_field_name("type") if above is not None else None
    is_named = type_ is not None and type_.type != "placeholder_type_specifier"
    return type_ if is_named else None
