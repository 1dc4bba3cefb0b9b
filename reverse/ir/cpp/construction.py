"""Construction by constructors and conversion functions ([class.ctor], [class.conv])."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.classes import (
    copies_trivially,
    implicit_constructor,
    is_base,
    is_copy,
    needs_constructor,
)
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value
from rebsync.reverse.ir.cpp.functions_called import call, default_arguments, library_arguments
from rebsync.reverse.ir.cpp.objects import (
    UNKNOWN_CONSTRUCTOR,
    as_value,
    assigned_memberwise,
    implicitly,
    passed,
)
from rebsync.reverse.ir.cpp.overloads import (
    conversion_function,
    resolve,
    signature,
)
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, FunctionSymbol
from rebsync.source import Span


def construct(
    context: Context, target: e.Lvalue, owner: ClassSymbol, values: list[Value], place: Span
) -> None:
    """An object of a class in a variable, of values as arguments."""
    constructors = [f for f in owner.constructors if not _is_implicit(owner, f)]
    type_ = t.Record(owner.name)
    is_copy_of = len(values) == 1 and (
        values[0].type == type_ or is_base(context.world, type_, values[0].type)
    )
    if is_copy_of and not any(is_copy(owner, f) for f in constructors):
        _copy_constructed(context, target, owner, values[0], place)
        return
    if not constructors:
        if values:
            raise Unlowered("a construction that no constructor is declared for")
        constructor = None
        if needs_constructor(context.world, owner):
            constructor = implicit_constructor(owner)
        context.emit(s.Construct(target, owner.name, (), constructor, place))
        return
    function = resolve(context, constructors, list(values))
    if function.is_default and not values:
        name = implicit_constructor(owner)
        context.emit(s.Construct(target, owner.name, (), name, place))
        return
    parameters = signature(context.world, function).parameters
    passed_values = [
        passed(context, v, p.declared, place) for v, p in zip(values, parameters, strict=False)
    ]
    passed_values += default_arguments(context, function, len(values), place)
    arguments = tuple(s.CallArgument(a) for a in passed_values)
    context.emit(s.Construct(target, owner.name, arguments, function.name, place))


def _is_implicit(owner: ClassSymbol, function: FunctionSymbol) -> bool:
    """Whether the language makes the function's body: a defaulted copy or move constructor."""
    return function.is_default and is_copy(owner, function)


def _copy_constructed(
    context: Context, target: e.Lvalue, owner: ClassSymbol, value: Value, place: Span
) -> None:
    """The implicit copy constructor ([class.copy.ctor])."""
    if any(is_copy(owner, f) and f.is_deleted for f in owner.constructors):
        raise Unlowered("a copy of what cannot be copied")
    if copies_trivially(context.world, t.Record(owner.name)):
        if value.type == t.Record(owner.name):
            context.emit(s.Assign(target, as_value(context, value, place), place))
            return
        context.emit(s.Construct(target, owner.name, (), None, place))
        assigned_memberwise(context, owner, target, value.expression, place)
        return
    raise Unlowered("a copy that a class makes by itself of parts that do more")


def conversion(
    context: Context, value: Value, owner: ClassSymbol, to: t.Type, place: Span
) -> Value | None:
    """A conversion function of an object's class ([class.conv.fct])."""
    function = conversion_function(owner, context.world, to)
    if function is None:
        return None
    return implicitly(context, call(context, function, [], place, value), to, place)


def call_library(
    context: Context, target: e.Lvalue, type_: t.Type, nodes: Sequence[Node], place: Span
) -> None:
    """An object of a library, constructed of arguments that it may look at and change."""
    arguments = library_arguments(context, nodes, place, is_pure=False)
    if isinstance(type_, t.Record | t.RosMessage):
        context.emit(s.Call(target, s.LibraryCallee(type_.name), arguments, place))
        return
    if type_ != t.UNKNOWN:
        raise Unlowered("a construction by arguments that is not known")
    callee = s.LibraryCallee(UNKNOWN_CONSTRUCTOR)
    context.emit(s.Call(target, callee, arguments, place))
