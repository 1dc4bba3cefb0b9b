"""Explicit conversions ([expr.cast], [expr.static.cast]), `sizeof`, `new` and `delete`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import ends_silently, methods_named
from rebsync.reverse.ir.cpp.context import (
    Context,
    Unlowered,
    Value,
    lower_value,
    lowers_expression,
    unsupported,
)
from rebsync.reverse.ir.cpp.conversions import converted
from rebsync.reverse.ir.cpp.functions_called import callee_of
from rebsync.reverse.ir.cpp.initialisation import by_arguments, initialised
from rebsync.reverse.ir.cpp.objects import (
    address,
    class_of,
    implicitly,
)
from rebsync.reverse.ir.cpp.types import SIZE, Declared, ReferenceKind
from rebsync.reverse.ir.dump_types import dump_type
from rebsync.reverse.ir.operators import Conversion
from rebsync.reverse.libraries.outcome_classes import UNKNOWN_CLASS
from rebsync.reverse.syntax.cpp_tree import named, part
from rebsync.source import Span

NAMED_CASTS = frozenset({"static_cast", "const_cast", "reinterpret_cast", "dynamic_cast"})


def named_cast(
    context: Context, name: str, types: Sequence[Node], nodes: Sequence[Node], place: Span
) -> Value:
    """`static_cast<T>(x)` and its kin."""
    if len(types) != 1 or len(nodes) != 1:
        raise Unlowered("a cast of other than one value")
    declared = context.world.types.descriptor(context.cpp, context.scope, types[0])
    value = lower_value(context, nodes[0])
    if name == "dynamic_cast":
        return _dynamic(context, value, declared, place)
    if name == "reinterpret_cast" and not isinstance(declared.type, t.Reference):
        raise Unlowered("bits taken for those of another type")
    return cast(context, value, declared, place)


def _dynamic(context: Context, value: Value, declared: Declared, place: Span) -> Value:
    """`dynamic_cast<T*>(p)`: null where the object is of no such class; it is up to its class.

    `dynamic_cast<T&>(x)` throws there ([expr.dynamic.cast]).
    """
    if declared.reference is not ReferenceKind.NONE:
        argument = s.CallArgument(address(context, value, place))
        context.emit(s.Call(None, s.LibraryCallee("dynamic_cast"), (argument,), place))
        return Value(value.expression, declared.type, value.is_lvalue)
    if not isinstance(declared.type, t.Reference):
        raise Unlowered("a dynamic cast to what is no pointer")
    found = e.Convert(Conversion.CAST, value.expression, declared.type, True, place)
    return Value(found, declared.type)


@lowers_expression("cast_expression")
def c_cast(context: Context, node: Node) -> Value:
    """`(T)x`."""
    declared = context.world.types.descriptor(context.cpp, context.scope, part(node, "type"))
    return cast(context, lower_value(context, part(node, "value")), declared, context.place(node))


def cast(context: Context, value: Value, declared: Declared, place: Span) -> Value:
    """What a static cast gives: implicit conversions, and those to enumerations and void."""
    to = declared.type
    if declared.reference is not ReferenceKind.NONE:
        is_lvalue = value.is_lvalue and declared.reference is not ReferenceKind.RVALUE
        return Value(value.expression, to, is_lvalue)
    match to:
        case t.Unknown():  # perhaps of a class, that has a constructor
            target = context.temporary(to, place)
            argument = s.CallArgument(value.expression)
            callee = s.LibraryCallee(UNKNOWN_CLASS)
            context.emit(s.Call(target, callee, (argument,), place))
            return Value(target, to)
        case t.UnitType():
            context.emit(s.Evaluate(value.expression, place))
            return Value(e.Literal(None, t.NOTHING, place=place), t.NOTHING)
        case t.Enumeration(_, underlying):
            number = cast(context, value, Declared(underlying), place).expression
            return Value(e.Convert(Conversion.CAST, number, to, False, place), to)
        case t.Reference() if value.is_lvalue or isinstance(value.type, t.Reference):
            found = converted(value.expression, value.type, to, place)
            if found is not None:
                return Value(found, to)
    return implicitly(context, Value(value.expression, value.type, value.is_lvalue), to, place)


@lowers_expression("sizeof_expression", "alignof_expression")
def size_of(context: Context, node: Node) -> Value:
    """`sizeof`: known of numbers; nothing is evaluated."""
    place, type_node = context.place(node), node.child_by_field_name("type")
    type_: t.Type = t.UNKNOWN
    if type_node is not None:
        type_ = context.world.types.descriptor(context.cpp, context.scope, type_node).type
    elif (value := node.child_by_field_name("value")) is not None:
        with context.body(), context.trial():
            type_ = lower_value(context, value).type
    count = _bytes(type_) if node.type == "sizeof_expression" else None
    if count is not None:
        return Value(e.Literal(count, SIZE, place=place), SIZE)
    target = context.temporary(SIZE, place)
    context.emit(s.Call(target, s.LibraryCallee("sizeof"), (), place))
    return Value(target, SIZE)


def _bytes(type_: t.Type) -> int | None:
    match type_:
        case t.Integer(int(bits)) | t.Float(bits):
            return bits // 8 if bits % 8 == 0 else None
        case t.Truth():
            return 1
        case t.Enumeration(_, underlying):
            return _bytes(underlying)
        case t.Array(element, length):
            inner = _bytes(element)
            return None if inner is None else inner * length
        case _:
            return None


@lowers_expression("new_expression")
def new(context: Context, node: Node) -> Value:
    """`new T(a)`: an object that a pointer leads to."""
    place = context.place(node)
    if node.child_by_field_name("placement"):
        raise Unlowered("a place for a new object")
    type_ = context.world.types.of(context.cpp, context.scope, part(node, "type"))
    length = node.child_by_field_name("declarator")
    if length is not None:
        return _new_array(context, length, type_, place)
    arguments = node.child_by_field_name("arguments")
    nodes = [] if arguments is None else [arguments]
    return created(context, type_, t.Reference(type_, True), nodes, place)


def _new_array(context: Context, length: Node, type_: t.Type, place: Span) -> Value:
    """`new T[n]` of what no constructor makes."""
    counts = named(length)
    if len(counts) != 1 or class_of(context, type_) is not None or type_ == t.UNKNOWN:
        raise Unlowered("an array of new objects")
    _allocates(context, "operator new[]", type_, place)
    count = implicitly(context, lower_value(context, counts[0]), SIZE, place).expression
    pointer = t.Reference(type_, may_be_null=True)
    target = context.temporary(pointer, place)
    context.emit(s.Call(target, s.LibraryCallee("new[]"), (s.CallArgument(count),), place))
    return Value(target, pointer)


def created(
    context: Context, type_: t.Type, pointer: t.Reference, nodes: Sequence[Node], place: Span
) -> Value:
    """A new object with the pointer to it; `nodes` is the list of arguments, or empty."""
    _allocates(context, "operator new", type_, place)
    if class_of(context, type_) is None:
        return _created_value(context, type_, pointer, nodes, place)
    target = context.temporary(pointer, place)
    mark = len(context.out)
    if nodes and nodes[0].type == "initializer_list":
        initialised(context, target, type_, nodes[0])
    else:
        by_arguments(context, target, type_, named(nodes[0]) if nodes else [], place)
    last = context.out[-1] if len(context.out) > mark else None
    if isinstance(last, s.Construct) or (
        isinstance(last, s.Assign) and isinstance(last.value, e.Copy | e.Move | e.BuildRecord)
    ):
        return Value(target, pointer)
    raise Unlowered("a new object that is made in parts")


def _allocates(context: Context, name: str, type_: t.Type, place: Span) -> None:
    """What the program itself does to get memory, or to free it ([class.free], [new.delete])."""
    owner = class_of(context, type_)
    own = methods_named(context.world, owner.name, name) if owner is not None else []
    for function in own or context.world.symbols.overloads.get(name, []):
        context.emit(s.Call(None, callee_of(function), (), place))


def _created_value(
    context: Context, type_: t.Type, pointer: t.Reference, nodes: Sequence[Node], place: Span
) -> Value:
    """A new number, text or object of a library."""
    if nodes and nodes[0].type == "initializer_list":
        raise Unlowered("a new value of a list in braces")
    inner = named(nodes[0]) if nodes else []
    values = [lower_value(context, n) for n in inner]
    arguments = tuple(s.CallArgument(v.expression) for v in values)
    target = context.temporary(pointer, place)
    name = f"new<{dump_type(type_)}>"
    if isinstance(type_, t.Record | t.RosMessage):
        name = f"new {type_.name}"
    context.emit(s.Call(target, s.LibraryCallee(name), arguments, place))
    return Value(target, pointer)


@lowers_expression("delete_expression")
def delete(context: Context, node: Node) -> Value:
    """`delete p`: nothing where it is null, else the object ends."""
    place, inner = context.place(node), named(node)
    nothing = Value(e.Literal(None, t.NOTHING, place=place), t.NOTHING)
    value = lower_value(context, inner[0])
    if any(child.type == "[" for child in node.children):
        of = value.type.to if isinstance(value.type, t.Reference) else t.UNKNOWN
        if not ends_silently(context.world, of):
            element = e.Dereference(value.expression, of, True, place)
            name = of.name if isinstance(of, t.Record) else None
            context.emit(s.Destroy(element, name, place))
            return _ends_somehow(context, node, "an array of objects that end")
        _allocates(context, "operator delete[]", of, place)
        argument = s.CallArgument(value.expression)
        context.emit(s.Call(None, s.LibraryCallee("delete[]"), (argument,), place))
        return nothing
    if not isinstance(value.type, t.Reference):
        return _ends_somehow(context, node, "the end of what is not known")
    pointer = value.expression
    object_ = e.Dereference(pointer, value.type.to, value.type.to == t.UNKNOWN, place)
    name = value.type.to.name if isinstance(value.type.to, t.Record) else None
    test = e.Convert(Conversion.TRUTH, pointer, t.TRUTH, False, place)
    context.emit(s.If(test, (s.Destroy(object_, name, place),), (), False, place))
    _allocates(context, "operator delete", value.type.to, place)
    return nothing


def _ends_somehow(context: Context, node: Node, what: str) -> Value:
    """Destructors of which nothing is known, but that they do not raise ([class.dtor])."""
    context.emit(replace(unsupported(context, node, what), raises=False))
    return Value(e.Literal(None, t.NOTHING, place=context.place(node)), t.NOTHING)
