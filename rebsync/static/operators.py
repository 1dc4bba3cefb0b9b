"""The result types of operators."""

from __future__ import annotations

from rebsync.model import Type
from rebsync.static.symbols import Classes
from rebsync.static.types import (
    BOOLEAN,
    common,
    converts,
    is_boolean,
    is_integer,
    is_numeric,
    is_rebec,
    wider,
)

_ARITHMETIC = frozenset("+-*/")
_INTEGER = frozenset(("%", "<<", ">>"))
_BITWISE = frozenset("&|^")
_ORDER = frozenset(("<", ">", "<=", ">="))
_EQUALITY = frozenset(("==", "!="))


def binary_type(operator: str, left: Type, right: Type, classes: Classes) -> Type | None:
    """The type of `left operator right`, or None when the operator is not for such values."""
    if operator in _EQUALITY:
        return BOOLEAN if _comparable(left, right, classes) else None
    if is_boolean(left) and is_boolean(right):
        return BOOLEAN if operator in ("&&", "||") or operator in _BITWISE else None
    if not is_numeric(left) or not is_numeric(right):
        return None
    if operator in _ARITHMETIC:
        return wider(left, right)
    if operator in _ORDER:
        return BOOLEAN
    integers = is_integer(left) and is_integer(right)
    if integers and (operator in _INTEGER or operator in _BITWISE):
        return wider(left, right)
    return None


def unary_type(operator: str, operand: Type) -> Type | None:
    """The type of a prefix or postfix operator, or None when it is not for such a value."""
    match operator:
        case "!":
            fits = is_boolean(operand)
        case "+" | "-":
            fits = is_numeric(operand)
        case _:
            fits = is_integer(operand)
    return operand if fits else None


def _comparable(left: Type, right: Type, classes: Classes) -> bool:
    if left.name == "null" and right.name == "null":
        return True
    met = common(left, right, classes)
    return met is not None and (is_numeric(met) or is_boolean(met) or is_rebec(met))


def assigns(operator: str, left: Type, right: Type, classes: Classes) -> bool:
    """Whether the compound assignment `left operator= right` fits: its result must fit `left`."""
    result = binary_type(operator, left, right, classes)
    return result is not None and converts(result, left, classes)
