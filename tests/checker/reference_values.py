"""Values and arithmetic of the reference: 32-bit after C's promotions, narrowed when stored.

A number is tagged with its type in C: "byte", "short", "int", "float", "double", "boolean", or
"rebec", whose value is a place in `main`, None for null. Arrays are tuples.
"""

from __future__ import annotations

import math
import struct
from typing import TypeAlias

from rebsync import model as m

Number: TypeAlias = "int | float | bool"
Value: TypeAlias = "Number | tuple[Value, ...] | None"
Tagged: TypeAlias = "tuple[str, Value]"

_BITS = {"byte": 8, "short": 16, "int": 32}
_FLOATING = ("float", "double")


def tag(type_: m.Type) -> str:
    """The kind of the elements of a type."""
    return type_.name if type_.name in (*_BITS, *_FLOATING, "boolean") else "rebec"


def zero(type_: m.Type) -> Value:
    """What a variable holds before anything is stored."""
    if type_.dimensions:
        return (zero(m.Type(type_.name, type_.dimensions[1:])),) * type_.dimensions[0]
    return {"boolean": False, "float": 0.0, "double": 0.0, "rebec": None}.get(tag(type_), 0)


def wrap(value: int, bits: int = 32) -> int:
    """What an integer of so many bits keeps of a value."""
    kept = value & ((1 << bits) - 1)
    return kept - (1 << bits) if kept >> (bits - 1) else kept


def single(value: float) -> float:
    """The float of 32 bits nearest to a value."""
    if math.isinf(value) or math.isnan(value):
        return value
    try:
        return float(struct.unpack("<f", struct.pack("<f", value))[0])
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def convert(value: Value, kind: str) -> Value:
    """A value as one of a kind; arrays element by element."""
    if isinstance(value, tuple):
        return tuple(convert(v, kind) for v in value)
    if value is None or kind in ("boolean", "rebec"):
        return value
    if kind in _FLOATING:
        return single(float(value)) if kind == "float" else float(value)
    if isinstance(value, float):
        fits = not math.isnan(value) and -(2**31) - 1 < value < 2**31
        value = int(value) if fits else -(2**31)
    return wrap(int(value), _BITS[kind])


def promoted(kind: str) -> str:
    """The kind in which C computes."""
    return "int" if kind in _BITS else kind


def negative(operator: str, operand: Tagged) -> Tagged:
    """The operators `+ - ! ~` on one value."""
    kind, value = operand
    if operator == "!":
        return "boolean", not value
    assert isinstance(value, int | float)
    kind = promoted(kind)
    if operator == "~":
        return kind, ~int(value)
    return kind, convert(-value if operator == "-" else value, kind)


def operate(operator: str, left: Tagged, right: Tagged) -> Tagged:
    """A binary operator on two values; ZeroDivisionError only for integers."""
    if operator in ("==", "!=") and "rebec" in (left[0], right[0]):
        return "boolean", (left[1] == right[1]) is (operator == "==")
    kinds = (promoted(left[0]), promoted(right[0]))
    kind = max(kinds, key=("boolean", "int", "float", "double").index)
    a, b = convert(left[1], kind), convert(right[1], kind)
    assert isinstance(a, int | float) and isinstance(b, int | float)
    if operator in _COMPARED:
        return "boolean", _compared(operator, a, b)
    if kind == "boolean":
        return kind, {"&": bool(a) & bool(b), "|": bool(a) | bool(b), "^": a != b}[operator]
    if kind == "int":
        return kind, wrap(_integers(operator, int(a), int(b)))
    return kind, convert(_floats(operator, float(a), float(b)), kind)


_COMPARED = ("<", "<=", ">", ">=", "==", "!=")


def _compared(operator: str, a: Number, b: Number) -> bool:
    match operator:
        case "<":
            return a < b
        case "<=":
            return a <= b
        case ">":
            return a > b
        case ">=":
            return a >= b
        case "==":
            return a == b
        case _:
            return a != b


def _integers(operator: str, a: int, b: int) -> int:
    match operator:
        case "+":
            return a + b
        case "-":
            return a - b
        case "*":
            return a * b
        case "/":
            return int(math.copysign(1, a) * math.copysign(1, b)) * (abs(a) // abs(b))
        case "%":
            return int(math.copysign(1, a)) * (abs(a) % abs(b))
        case "<<":
            return a << (b & 31)
        case ">>":
            return a >> (b & 31)
        case "&":
            return a & b
        case "|":
            return a | b
        case "^":
            return a ^ b
        case _:
            raise NotImplementedError(operator)


def _floats(operator: str, a: float, b: float) -> float:
    match operator:
        case "+":
            return a + b
        case "-":
            return a - b
        case "*":
            return a * b
        case "/" if b == 0:
            if a == 0 or math.isnan(a):
                return math.nan
            return math.copysign(math.inf, math.copysign(1, a) * math.copysign(1, b))
        case "/":
            return a / b
        case _:
            raise NotImplementedError(operator)


def root(value: float) -> float:
    """C's `sqrt`."""
    return math.sqrt(value) if value >= 0 else math.nan


def raised(base: float, exponent: float) -> float:
    """C's `pow`, for the small numbers that tests use."""
    try:
        return math.pow(base, exponent)
    except ValueError:
        return math.nan if base else math.inf
    except OverflowError:
        return -math.inf if base < 0 and exponent % 2 == 1 else math.inf


def bits(value: Value) -> object:
    """What decides whether two values are the same: floats by their bits, one NaN for all."""
    if isinstance(value, tuple):
        return tuple(bits(v) for v in value)
    if isinstance(value, float):
        return struct.pack(">d", math.nan if math.isnan(value) else value)
    return value
