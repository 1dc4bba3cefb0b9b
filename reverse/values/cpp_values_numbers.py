"""Texts and numbers: sums, other operations, and what variables of a type make of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

from rebsync.reverse.graph import FromParameter, OneOf, Plain, Unresolved
from rebsync.reverse.syntax.cpp_numbers import whole_result
from rebsync.reverse.values.cpp_values_plain import FLOATING, WHOLE, Choice, Nothing, Value, each


def added(left: Value, right: Value) -> Value:
    """The sum of two values: of texts, the one after the other."""
    match left, right:
        case str(), str():
            return left + right
        case ((int() | float()), (int() | float())):
            return left + right
        case (Unresolved(), str()) | (str(), Unresolved()) | (Unresolved(), Unresolved()):
            unknown = cast(Unresolved, left if isinstance(left, Unresolved) else right)
            partial = "".join(
                (v.partial or "*") if isinstance(v, Unresolved) else str(v) for v in (left, right)
            )
            return Unresolved(unknown.why, unknown.place, partial.replace("**", "*"))
        case FromParameter(), str():
            return _behind(left, right)
        case str(), FromParameter():
            return used(right, f'"{left}" + value', lambda v: added(left, v))
        case FromParameter(), (int() | float()):
            return used(left, f"value+{right}", lambda v: added(v, right))
        case ((int() | float()), FromParameter()):
            return used(right, f"{left}+value", lambda v: added(left, v))
        case _:
            return Nothing()


def _behind(value: FromParameter, text: str) -> FromParameter:
    """A text behind the value of a parameter; without the parameter it is behind nothing."""
    expression = value.expression
    if expression is not None and expression.startswith("value + ") and expression.endswith('"'):
        expression = f'{expression[:-1]}{text}"'
    else:
        expression = used(value, f'value + "{text}"', lambda v: v).expression
    before = value.default if value.default is not None else ""
    default = added(before, text)
    known = default if isinstance(default, str) else None
    return FromParameter(value.name, known, expression, value.search, value.within)


def used(value: FromParameter, expression: str, do: Callable[[Value], Value]) -> FromParameter:
    """A parameter's value used in an expression, with `value` for it; so is its default."""
    if value.expression is not None:
        inner = value.expression if value.expression.isalnum() else f"({value.expression})"
        expression = expression.replace("value", inner)
    default = each(do, value.default) if value.default is not None else None
    known = default if isinstance(default, (bool, int, float, str)) else None
    return FromParameter(value.name, known, expression, value.search, value.within)


_TOO_LARGE = 1e300  # what is near the end of the floats, or beyond it, is not computed with


def computed(operator: str, left: Plain, right: Plain) -> Plain | None:
    """The result of an operation on plain values, as C++ computes it; None where it has none."""
    match left, right:
        case str(), str() if operator in ("==", "!=", "+"):
            return left + right if operator == "+" else (left == right) == (operator == "==")
        case ((bool() | int() | float()), (bool() | int() | float())):
            try:
                result = _number(operator, left, right)
            except OverflowError:
                return None
            return result if result is None or abs(result) < _TOO_LARGE else None
        case _:
            return None


def _number(operator: str, a: float, b: float) -> int | float | None:
    if isinstance(a, int) and isinstance(b, int):
        whole = whole_result(operator, a, b)
        if whole is not None:
            return whole
    match operator:
        case "+":
            return a + b
        case "-":
            return a - b
        case "*":
            return a * b
        case "/" if b:
            return a / b
        case "<":
            return a < b
        case ">":
            return a > b
        case "<=":
            return a <= b
        case ">=":
            return a >= b
        case "==":
            return a == b
        case "!=":
            return a != b
        case "&&":
            return bool(a) and bool(b)
        case "||":
            return bool(a) or bool(b)
        case _:
            return None


def converted(value: Value, type_: str) -> Value:
    """A value in a variable of a type: whole numbers as such, in floating point as such."""
    match value:
        case bool() if type_ in WHOLE:
            return int(value)
        case int() | float() if type_ == "bool":
            return bool(value)
        case int() if type_ in FLOATING and not isinstance(value, bool):
            return float(value)
        case float() if type_ in WHOLE:
            return int(value) if abs(value) < 1e18 else value
        case str() if type_ == "bool":
            return True  # the address of the text
        case FromParameter() if value.default is not None:
            default = converted(value.default, type_)
            plain = default if isinstance(default, (bool, int, float, str)) else value.default
            return FromParameter(value.name, plain, value.expression, value.search, value.within)
        case Choice() | OneOf():
            return each(lambda v: converted(v, type_), value)
        case _:
            return value
