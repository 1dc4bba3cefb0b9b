"""Initialisation ([dcl.init]): by expressions, by arguments, by lists in braces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import (
    DataMember,
    is_aggregate,
    members,
)
from rebsync.reverse.ir.cpp.containers import filled, text_of_parts
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value, lower_value
from rebsync.reverse.ir.cpp.elision import by_value
from rebsync.reverse.ir.cpp.objects import (
    address,
    as_value,
    class_of,
    default_constructed,
    default_value,
    implicitly,
    locked,
)
from rebsync.reverse.ir.cpp.sequencing import in_order
from rebsync.reverse.ir.cpp.symbols import ClassSymbol
from rebsync.reverse.ir.cpp.types import ReferenceKind
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.source import Span

# What may be a text of which a part is taken, and no letter of one that is listed.
_PLACES = frozenset({"identifier", "field_expression", "qualified_identifier"})


def initialised(context: Context, target: e.Lvalue, type_: t.Type, node: Node) -> None:
    """Emits what gives a new object its first value."""
    place = context.place(node)
    if node.type == "initializer_list":
        braced(context, target, type_, node)
        return
    if node.type == "argument_list":
        by_arguments(context, target, type_, [*named(node)], place)
        return
    value = lower_value(context, node)
    by_value(context, target, type_, value, place)


def by_arguments(
    context: Context, target: e.Lvalue, type_: t.Type, nodes: Sequence[Node], place: Span
) -> None:
    """Direct-initialisation, `T x(a, b);`."""
    owner = class_of(context, type_)
    if owner is not None:
        values = [lower_argument(context, node) for node in nodes]
        context.world.construct(context, target, owner, values, place)
        return
    if not nodes:
        value_initialised(context, target, type_, place)
        return
    if isinstance(type_, t.Container) and type_.kind is t.ContainerKind.SEQUENCE:
        filled(context, target, type_, nodes, place)
        return
    if isinstance(type_, t.Record) and type_.name in context.world.types.tuples:
        _record(context, target, type_, context.world.types.tuples[type_.name], nodes, place)
        return
    if isinstance(type_, t.Record | t.RosMessage | t.Unknown):
        context.world.call_library(context, target, type_, nodes, place)
        return
    if isinstance(type_, t.Text) and len(nodes) > 1:
        text_of_parts(context, target, nodes, place)
        return
    if len(nodes) != 1:
        raise Unlowered("a construction by arguments that is not known")
    value = lower_value(context, nodes[0])
    is_shared = isinstance(type_, t.Reference) and type_.ownership is t.Ownership.SHARED
    if is_shared and not isinstance(target, e.Attribute):  # members get what libraries give
        locked(context, value, place, is_explicit=True)
    by_value(context, target, type_, value, place)


def lower_argument(context: Context, node: Node) -> Value:
    """An argument of a constructor that is a value; lists in braces are up to its parameters."""
    if node.type == "initializer_list":
        raise Unlowered("a list in braces as an argument of a constructor")
    return lower_value(context, node)


def value_initialised(context: Context, target: e.Lvalue, type_: t.Type, place: Span) -> None:
    """`T x{};`: zeros where no constructor runs."""
    value = default_value(context, type_, place)
    if value is not None:
        context.emit(s.Assign(target, value, place))
    else:
        default_constructed(context, target, type_, place)


# --- lists in braces ([dcl.init.list]) ------------------------------------------------------------


def braced(context: Context, target: e.Lvalue, type_: t.Type, node: Node) -> None:
    """`T x{a, b};` and `T x = {a, b};`."""
    place, nodes = context.place(node), named(node)
    owner = class_of(context, type_)
    if owner is not None:
        _braced_object(context, target, owner, type_, nodes, place)
        return
    if not nodes:
        value_initialised(context, target, type_, place)
        return
    match type_:
        case t.Container(t.ContainerKind.MAPPING, (key, value)):
            context.emit(
                s.Assign(target, _mapping(context, type_, key, value, nodes, place), place)
            )
        case t.Container(_, (element, *_)):
            built = _elements(context, element, nodes, place)
            context.emit(s.Assign(target, e.Build(type_, built, place), place))
        case t.Array(element, length):
            _array(context, target, type_, element, length, nodes, place)
        case t.Record(name) if name in context.world.types.tuples:
            _record(context, target, type_, context.world.types.tuples[name], nodes, place)
        case t.Optional() | t.Integer() | t.Float() | t.Truth() | t.Enumeration() | t.Text():
            _only(context, target, type_, nodes, place)
        case t.Reference() | t.FunctionType():
            _only(context, target, type_, nodes, place)
        case _:
            context.world.call_library(context, target, type_, nodes, place)


def _only(
    context: Context, target: e.Lvalue, type_: t.Type, nodes: Sequence[Node], place: Span
) -> None:
    if isinstance(type_, t.Text) and len(nodes) > 1 and nodes[0].type in _PLACES:
        text_of_parts(context, target, nodes, place)
        return
    if len(nodes) != 1:
        raise Unlowered("a list in braces for one value")
    initialised(context, target, type_, nodes[0])


def element_value(context: Context, type_: t.Type, node: Node) -> e.Expression:
    """One element of a list in braces."""
    place = context.place(node)
    if node.type == "initializer_list" or class_of(context, type_) is not None:
        target = context.temporary(type_, place)
        mark = len(context.out)
        initialised(context, target, type_, node)
        last = context.out[-1] if len(context.out) > mark else None
        if isinstance(last, s.Assign) and last.target == target:
            context.out.pop()
            return last.value
        return target
    return as_value(context, implicitly(context, lower_value(context, node), type_, place), place)


def _elements(
    context: Context, element: t.Type, nodes: Sequence[Node], place: Span
) -> tuple[e.Expression, ...]:
    return tuple(in_order(context, [_operand(context, element, n) for n in nodes], place))


def _operand(context: Context, type_: t.Type, node: Node) -> Callable[[], Value]:
    return lambda: Value(element_value(context, type_, node), type_)


def _mapping(
    context: Context, type_: t.Container, key: t.Type, value: t.Type, nodes: list[Node], place: Span
) -> e.Expression:
    """`{{k, v}, {k, v}}`; of equal keys the first counts here, the last in the form."""
    operands: list[Callable[[], Value]] = []
    for node in nodes:
        inner = named(node) if node.type == "initializer_list" else []
        if len(inner) != 2:
            raise Unlowered("an entry of a map that is no pair in braces")
        operands += [_operand(context, key, inner[0]), _operand(context, value, inner[1])]
    found = in_order(context, operands, place)
    entries = list(zip(found[::2], found[1::2], strict=True))
    return e.BuildMapping(type_, tuple(reversed(entries)), place)


def _array(
    context: Context,
    target: e.Lvalue,
    type_: t.Array,
    element: t.Type,
    length: int,
    nodes: list[Node],
    place: Span,
) -> None:
    """Elements, and default values for those that lack; braces in braces may be elided."""
    is_inner = isinstance(element, t.Array | t.Container | t.Record | t.RosMessage)
    if len(nodes) == 1 and nodes[0].type == "initializer_list" and not is_inner:
        nodes = named(nodes[0])
    if len(nodes) > length or length > 4096:
        raise Unlowered("an array of other length than its braces")
    given = _elements(context, element, nodes, place)
    rest = default_value(context, element, place)
    if rest is None and len(nodes) < length:
        raise Unlowered("an array with objects that are constructed")
    filled = () if rest is None else (rest,) * (length - len(nodes))
    context.emit(s.Assign(target, e.Build(type_, (*given, *filled), place), place))


def _record(
    context: Context,
    target: e.Lvalue,
    type_: t.Record,
    fields: tuple[tuple[str, t.Type], ...],
    nodes: Sequence[Node],
    place: Span,
) -> None:
    """A pair or tuple."""
    if len(nodes) != len(fields):
        raise Unlowered("a tuple of other length than its arguments")
    operands = [_operand(context, of, n) for (_, of), n in zip(fields, nodes, strict=True)]
    values = in_order(context, operands, place)
    names = [name for name, _ in fields]
    built = e.BuildRecord(type_, tuple(zip(names, values, strict=True)), place)
    context.emit(s.Assign(target, built, place))


def _braced_object(
    context: Context,
    target: e.Lvalue,
    owner: ClassSymbol,
    type_: t.Type,
    nodes: list[Node],
    place: Span,
) -> None:
    if not is_aggregate(owner):
        by_arguments(context, target, type_, nodes, place)
        return
    if len(nodes) == 1 and nodes[0].type != "initializer_list":
        value_type = _type_of(context, nodes[0])
        if value_type == type_:
            initialised(context, target, type_, nodes[0])
            return
    _aggregate(context, target, owner, nodes, place)


def _type_of(context: Context, node: Node) -> t.Type | None:
    """The type of an expression; nothing of it is emitted."""
    with context.body(), context.trial():
        try:
            return lower_value(context, node).type
        except Unlowered:
            return None


def _aggregate(
    context: Context, target: e.Lvalue, owner: ClassSymbol, nodes: list[Node], place: Span
) -> None:
    """Aggregate initialisation ([dcl.init.aggr]): fields in order, then their own initialisers."""
    fields = list(members(context.world, owner))
    given = _designated(fields, nodes)
    operands: list[Callable[[], Value]] = []
    for field in fields:
        node = given.get(field.key)
        if node is None:
            if field.declared.reference is not ReferenceKind.NONE:
                raise Unlowered("an aggregate with a reference to nothing")
            operands.append(partial(_own_value, context, owner, field, place))
        elif field.declared.reference is not ReferenceKind.NONE:
            operands.append(partial(_referred, context, node, place))
        else:
            operands.append(_operand(context, field.declared.type, node))
    values = in_order(context, operands, place)
    pairs = tuple((f.key, v) for f, v in zip(fields, values, strict=True))
    built = e.BuildRecord(t.Record(owner.name), pairs, place)
    context.emit(s.Assign(target, built, place))


def _designated(fields: Sequence[DataMember], nodes: Sequence[Node]) -> dict[str, Node]:
    """The elements of a list in braces by the fields that they are for: `{a, b}`, `{.y = b}`."""
    if not any(n.type == "initializer_pair" for n in nodes):
        if len(nodes) > len(fields):
            raise Unlowered("a list in braces that is longer than the object")
        return {f.key: n for f, n in zip(fields, nodes, strict=False)}
    found = {}
    for node in nodes:
        designator = node.child_by_field_name("designator")
        name = text_of(designator).removeprefix(".") if designator is not None else ""
        field = next((f for f in fields if f.symbol.name == name), None)
        if field is None:
            raise Unlowered("a designated initialiser of this kind")
        found[field.key] = part(node, "value")
    return found


def _referred(context: Context, node: Node, place: Span) -> Value:
    """The object that a field refers to."""
    value = lower_value(context, node)
    if not value.is_lvalue:
        raise Unlowered("a member that refers to a temporary")
    return Value(address(context, value, place), t.Reference(value.type))


def _own_value(context: Context, owner: ClassSymbol, field: DataMember, place: Span) -> Value:
    """What a field is where no element is given for it."""
    type_, node = field.declared.type, field.symbol.value
    if node is not None:
        with context.reading(field.symbol.cpp, owner.name, place):
            return Value(element_value(context, type_, node), type_)
    value = default_value(context, type_, place)
    if value is not None:
        return Value(value, type_)
    target = context.temporary(type_, place)
    default_constructed(context, target, type_, place)
    return Value(target, type_)
