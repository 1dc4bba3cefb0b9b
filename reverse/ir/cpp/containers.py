"""Containers and texts made of counts, of ranges, of lists in braces ([sequence.reqmts])."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import copies_trivially
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    lower_value,
    lowers_expression,
)
from rebsync.reverse.ir.cpp.conversions import is_arithmetic
from rebsync.reverse.ir.cpp.elision import by_value
from rebsync.reverse.ir.cpp.objects import as_value, class_of, default_value, implicitly
from rebsync.reverse.ir.cpp.sequencing import in_order
from rebsync.reverse.syntax.cpp_tree import named, text_of
from rebsync.source import Span

FROM_RANGE = "std::vector::from_range"


@lowers_expression("initializer_list")
def list_in_braces(context: Context, node: Node) -> Value:
    """`{a, b}` for what is not known: its elements, of which that is made."""
    operands = [partial(lower_value, context, each) for each in named(node)]
    values = tuple(in_order(context, operands, context.place(node)))
    type_ = t.Container(t.ContainerKind.SEQUENCE, (t.UNKNOWN,))
    return Value(e.Build(type_, values, context.place(node)), t.UNKNOWN)


def filled(
    context: Context, target: e.Lvalue, type_: t.Container, nodes: Sequence[Node], place: Span
) -> None:
    """`std::vector<T> v(count, value);`."""
    element = type_.elements[0] if type_.elements else t.UNKNOWN
    values = [lower_value(context, node) for node in nodes]
    if len(values) == 1 and values[0].type == type_:
        by_value(context, target, type_, values[0], place)
        return
    if len(values) <= 2 and values[0].type == t.UNKNOWN:  # a count, perhaps
        arguments = tuple(s.CallArgument(v.expression) for v in values)
        context.emit(s.Call(target, s.LibraryCallee("std::vector"), arguments, place))
        return
    if not isinstance(values[0].type, t.Integer) or len(values) > 2:
        _of_range(context, target, element, values, place)
        return
    count = implicitly(context, values[0], t.Integer(64, False), place).expression
    if len(values) == 2:
        fill = as_value(context, implicitly(context, values[1], element, place), place)
    else:
        found = default_value(context, element, place)
        if found is None:
            raise Unlowered("a container of objects that are constructed")
        fill = found
    arguments = (s.CallArgument(count), s.CallArgument(fill))
    context.emit(s.Call(target, s.LibraryCallee("std::vector"), arguments, place))


def _of_range(
    context: Context, target: e.Lvalue, element: t.Type, values: Sequence[Value], place: Span
) -> None:
    """`std::vector<T> v(begin, end);`: copies of what is between two iterators."""
    owner = class_of(context, element)
    is_range = len(values) == 2 and not any(is_arithmetic(v.type) for v in values)
    if not is_range or (owner is not None and not copies_trivially(context.world, element)):
        raise Unlowered("a container made of a range")
    arguments = tuple(s.CallArgument(v.expression) for v in values)
    context.emit(s.Call(target, s.LibraryCallee(FROM_RANGE), arguments, place))


def text_of_parts(context: Context, target: e.Lvalue, nodes: Sequence[Node], place: Span) -> None:
    """`std::string s(count, 'x');` and `std::string s(other, position, count);`."""
    values = [lower_value(context, node) for node in nodes]
    if all(map(_is_iterator, nodes)):
        _of_range(context, target, t.Integer(8), values, place)
        return
    numbers = [isinstance(value.type, t.Integer) for value in values]
    is_part = isinstance(values[0].type, t.Text) and all(numbers[1:]) and len(values) <= 3
    is_unknown = values[0].type == t.UNKNOWN and numbers == [False, True]
    if not is_part and not is_unknown and numbers != [True, True]:
        raise Unlowered("a construction by arguments that is not known")
    found = [
        implicitly(context, v, t.Integer(64, False), place).expression
        if is_number and not (number == 1 and not is_part)
        else as_value(context, v, place)
        for number, (v, is_number) in enumerate(zip(values, numbers, strict=True))
    ]
    arguments = tuple(map(s.CallArgument, found))
    context.emit(s.Call(target, s.LibraryCallee("std::string"), arguments, place))


def _is_iterator(node: Node) -> bool:
    """Whether a value is an iterator by how it is named: `other.begin()`."""
    return text_of(node).endswith((".begin()", ".end()", ".cbegin()", ".cend()"))
