"""Constant values of the model as parameters of ROS."""

from __future__ import annotations

from rebsync.model import ArrayInitializer, Declarator, Initializer, Type
from rebsync.package import Value
from rebsync.static.constants import Lookup, constant


def env_value(declarator: Declarator, type_: Type, lookup: Lookup) -> Value:
    """The value of an env variable; what a short array leaves out is zero."""
    return _value(declarator.initial, type_, lookup)


def _value(initial: Initializer | None, type_: Type, lookup: Lookup) -> Value:
    if type_.dimensions:
        length, inner = type_.dimensions[0], Type(type_.name, type_.dimensions[1:])
        given = initial.values if isinstance(initial, ArrayInitializer) else ()
        values = [_value(v, inner, lookup) for v in given[:length]]
        return (*values, *[_value(None, inner, lookup)] * (length - len(values)))
    if initial is None or isinstance(initial, ArrayInitializer):
        return converted(0, type_)
    value = constant(initial, lookup)
    return converted(0 if value is None else value, type_)


def converted(value: int | float | bool, type_: Type) -> Value:
    """A constant as a value of its declared type."""
    match type_.name:
        case "boolean":
            return bool(value)
        case "float" | "double":
            return float(value)
        case _ if isinstance(value, float) and not abs(value) < 2**31:
            return -(2**31)  # as the checker has it: that is what x86 makes of what does not fit
        case _:
            return int(value)
