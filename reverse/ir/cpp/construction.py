"""Construction by constructors and conversion functions ([class.ctor], [class.conv])."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.alternatives import call_chosen, one_of
from rebsync.reverse.ir.cpp.classes import (
    called_implicitly,
    copies_trivially,
    is_base,
    is_copy,
    members,
    needs_constructor,
)
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value
from rebsync.reverse.ir.cpp.functions_called import call, default_arguments, library_arguments
from rebsync.reverse.ir.cpp.objects import (
    as_value,
    assigned_memberwise,
    class_of,
    implicitly,
    passed,
)
from rebsync.reverse.ir.cpp.overloads import (
    Ambiguous,
    conversion_function,
    resolve,
    signature,
)
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, FunctionSymbol
from rebsync.reverse.libraries.outcome_classes import UNKNOWN_CLASS
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
            constructor = called_implicitly(owner)
        context.emit(s.Construct(target, owner.name, (), constructor, place))
        return
    try:
        found: Sequence[FunctionSymbol] = [resolve(context, constructors, list(values))]
    except Ambiguous as error:
        found = error.functions
    bodies = []
    for function in found:
        with context.body() as body:
            _constructed_by(context, target, owner, function, values, place)
        bodies.append(tuple(body))
    one_of(context, bodies, place)


def _constructed_by(
    context: Context,
    target: e.Lvalue,
    owner: ClassSymbol,
    function: FunctionSymbol,
    values: list[Value],
    place: Span,
) -> None:
    """An object made by one of its class's constructors."""
    if function.is_default and not values:
        name = called_implicitly(owner)
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
        assigned_memberwise(context, owner, target, value, place)
        return
    context.emit(s.Construct(target, owner.name, (), None, place))
    _copied_parts(context, target, owner, value, place)


def _copied_parts(
    context: Context, target: e.Lvalue, owner: ClassSymbol, value: Value, place: Span
) -> None:
    """Bases and fields of a new object, each as its class is copied, or moved."""
    for name, base in context.world.symbols.bases(owner):
        if base is not None:
            _copied_base(context, target, base, value, place)
        else:
            full = context.world.types.imported(owner.cpp, name)
            argument = s.CallArgument(value.expression)
            context.emit(s.Call(None, s.LibraryCallee(full, target), (argument,), place))
    for member in members(context.world, owner):
        type_ = member.declared.form
        to = e.Attribute(target, member.key, type_, False, place)
        from_ = Value(
            e.Attribute(value.expression, member.key, type_, False, place), type_, value.is_lvalue
        )
        inner = class_of(context, type_)
        if inner is not None:
            construct(context, to, inner, [from_], place)
        else:
            copy = as_value(context, from_, place)
            context.emit(s.Assign(to, copy, place))


def _copied_base(
    context: Context, target: e.Lvalue, base: ClassSymbol, value: Value, place: Span
) -> None:
    value = replace(value, type=t.Record(base.name))
    written = [f for f in base.constructors if is_copy(base, f) and not _is_implicit(base, f)]
    if not written:
        _copied_parts(context, target, base, value, place)
        return
    this = Value(target, t.Record(base.name), is_lvalue=True)

    def call_of(function: FunctionSymbol) -> Value:
        declared = signature(context.world, function).parameters[0].declared
        argument = passed(context, value, declared, place)
        return call(context, function, [argument], place, this, True)

    call_chosen(context, written, [value], call_of, place)


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
    callee = s.LibraryCallee(UNKNOWN_CLASS)
    context.emit(s.Call(target, callee, arguments, place))
