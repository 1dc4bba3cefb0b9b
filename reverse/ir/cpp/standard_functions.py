"""Functions of the standard library that are part of how the language is used."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.casts import created
from rebsync.reverse.ir.cpp.context import Context, Value, lower_value
from rebsync.reverse.ir.cpp.names import field_of
from rebsync.reverse.ir.cpp.objects import address, as_value, class_of
from rebsync.reverse.ir.cpp.sequencing import in_any_order
from rebsync.reverse.syntax.cpp_tree import text_of
from rebsync.source import Span

Standard: TypeAlias = Callable[[Context, Sequence[Node], Sequence[Node], Span], "Value | None"]


def _move(
    context: Context, nodes: Sequence[Node], types: Sequence[Node], place: Span
) -> Value | None:
    """`std::move(x)`: an xvalue, whose object may be taken from."""
    if len(nodes) != 1:
        return None
    value = lower_value(context, nodes[0])
    is_number = isinstance(value.type, t.Integer | t.Float | t.Truth | t.Enumeration)
    if is_number or not value.is_lvalue:
        return Value(value.expression, value.type)
    if class_of(context, value.type) is not None:
        return Value(value.expression, value.type, is_lvalue=False)
    return Value(e.Move(value.expression, value.type, place), value.type)


def _forward(
    context: Context, nodes: Sequence[Node], types: Sequence[Node], place: Span
) -> Value | None:
    return lower_value(context, nodes[0]) if len(nodes) == 1 else None


def _reference(
    context: Context, nodes: Sequence[Node], types: Sequence[Node], place: Span
) -> Value | None:
    """`std::ref(x)`: a reference to it."""
    if len(nodes) != 1:
        return None
    value = lower_value(context, nodes[0])
    return Value(address(context, value, place), t.Reference(value.type))


def _make(ownership: t.Ownership) -> Standard:
    def make(
        context: Context, nodes: Sequence[Node], types: Sequence[Node], place: Span
    ) -> Value | None:
        """`std::make_shared<T>(a, b)`."""
        if len(types) != 1:
            return None
        type_ = context.world.types.descriptor(context.cpp, context.scope, types[0]).type
        if class_of(context, type_) is None:
            return None
        pointer = t.Reference(type_, True, ownership)
        arguments = nodes[0].parent if nodes else None
        return created(context, type_, pointer, [] if arguments is None else [arguments], place)

    return make


def _pair(
    context: Context, nodes: Sequence[Node], types: Sequence[Node], place: Span
) -> Value | None:
    """`std::make_pair(a, b)`."""
    return _record(context, nodes, "std::pair", ("first", "second"), place)


def _tuple(
    context: Context, nodes: Sequence[Node], types: Sequence[Node], place: Span
) -> Value | None:
    names = tuple(map(str, range(len(nodes))))
    return _record(context, nodes, "std::tuple", names, place)


def _record(
    context: Context, nodes: Sequence[Node], name: str, fields: tuple[str, ...], place: Span
) -> Value | None:
    if len(nodes) != len(fields):
        return None
    kinds: list[t.Type] = []

    def operand(node: Node) -> Callable[[], Value]:
        def lowered() -> Value:
            value = lower_value(context, node)
            kinds.append(value.type)
            return Value(as_value(context, value, place), value.type)

        return lowered

    values = in_any_order(context, [operand(node) for node in nodes], place)
    type_ = context.world.types.record_of(name, fields, tuple(kinds))
    built = e.BuildRecord(type_, tuple(zip(fields, values, strict=True)), place)
    return Value(built, type_)


def _get(
    context: Context, nodes: Sequence[Node], types: Sequence[Node], place: Span
) -> Value | None:
    """`std::get<0>(tuple)`."""
    if len(types) != 1 or len(nodes) != 1 or not text_of(types[0]).isdigit():
        return None
    value = lower_value(context, nodes[0])
    if not isinstance(value.type, t.Record) or value.type.name not in context.world.types.tuples:
        return None
    names = [name for name, _ in context.world.types.tuples[value.type.name]]
    number = int(text_of(types[0]))
    return field_of(context, value, names[number], place) if number < len(names) else None


STANDARD: Mapping[str, Standard] = {
    **{"move": _move, "forward": _forward, "as_const": _forward},
    **{"ref": _reference, "cref": _reference, "make_pair": _pair, "make_tuple": _tuple},
    **{"make_shared": _make(t.Ownership.SHARED), "make_unique": _make(t.Ownership.UNIQUE)},
    "get": _get,
}
