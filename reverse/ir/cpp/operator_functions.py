"""Operators that classes and enumerations of the program have ([over.oper])."""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.alternatives import call_chosen
from rebsync.reverse.ir.cpp.classes import (
    is_base,
    methods_named,
)
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value
from rebsync.reverse.ir.cpp.functions_called import call, default_arguments
from rebsync.reverse.ir.cpp.objects import (
    class_of,
    passed,
)
from rebsync.reverse.ir.cpp.overloads import (
    Ambiguous,
    ParameterSignature,
    resolve,
    signature,
)
from rebsync.reverse.ir.cpp.symbols import FunctionSymbol
from rebsync.source import Span


def call_operator(context: Context, name: str, values: list[Value], place: Span) -> Value | None:
    """An operator function for operands of which one is an object of the program ([over.oper])."""
    owners = [class_of(context, v.type) for v in values]
    enums = any(isinstance(v.type, t.Enumeration) for v in values)
    if not any(owners) and not enums:
        return None
    owner = owners[0]
    members = methods_named(context.world, owner.name, name) if owner is not None else []
    members = [f for f in members if not f.is_default]
    free = context.world.symbols.functions_named(name, context.scope, context.cpp.source.path)
    for value in values:
        if isinstance(value.type, t.Record | t.Enumeration):
            space = value.type.name.rpartition("::")[0]
            path = context.cpp.source.path
            found = context.world.symbols.functions_named(name, space, path)
            free = [*free, *(f for f in found if f not in free)]
    if name == "operator=" and not _fits(context, members, values):
        members = []
    if not members and not free:
        return None
    if members and (not free or _fits(context, members, values)):
        return call_chosen(
            context,
            members,
            values[1:],
            lambda f: call_with_values(context, f, values[1:], place, values[0]),
            place,
        )
    if not any(_fits_free(context, f, values) for f in free):
        return None
    return call_chosen(
        context, free, values, lambda f: call_with_values(context, f, values, place), place
    )


def _fits(context: Context, members: Sequence[FunctionSymbol], values: list[Value]) -> bool:
    """Whether a member operator takes the operands, as far as their number and classes tell."""
    if not members:
        return False
    try:
        resolve(context, members, values[1:])
    except Ambiguous:
        return True
    except Unlowered:
        return False
    only = [signature(context.world, f).parameters for f in members]
    return any(
        len(p) == len(values) - 1
        and all(_may_be(context, v, q) for v, q in zip(values[1:], p, strict=True))
        for p in only
    )


def _fits_free(context: Context, function: FunctionSymbol, values: list[Value]) -> bool:
    parameters = signature(context.world, function).parameters
    return len(parameters) == len(values) and all(
        _may_be(context, v, p) for v, p in zip(values, parameters, strict=True)
    )


def _may_be(context: Context, value: Value, parameter: ParameterSignature) -> bool:
    type_ = parameter.declared.type
    if (
        t.UNKNOWN in (value.type, type_)
        or value.type == type_
        or is_base(context.world, type_, value.type)
    ):
        return True
    is_number = isinstance(value.type, t.Integer | t.Float | t.Truth | t.Enumeration)
    return is_number and isinstance(type_, t.Integer | t.Float | t.Truth | t.Record)


def call_with_values(
    context: Context,
    function: FunctionSymbol,
    values: Sequence[Value],
    place: Span,
    receiver: Value | None = None,
) -> Value:
    """A call whose arguments are values that are there."""
    parameters = signature(context.world, function).parameters
    arguments = [
        passed(context, v, p.declared, place) for v, p in zip(values, parameters, strict=False)
    ]
    arguments += default_arguments(context, function, len(values), place)
    return call(context, function, arguments, place, receiver)
