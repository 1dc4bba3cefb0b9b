"""The value of a constant expression, in the arithmetic of the model: 32-bit, truncating."""

from __future__ import annotations

import math
import operator
import struct
from collections.abc import Callable
from typing import TypeAlias

from rebsync.model import (
    Binary,
    BoolLiteral,
    Cast,
    Conditional,
    Expression,
    FloatLiteral,
    IntLiteral,
    Name,
    Paren,
    Unary,
)

Value: TypeAlias = int | float | bool
Lookup: TypeAlias = Callable[[Name], Value | None]

_SINGLE = struct.Struct("<f")
_BITS = {"byte": 8, "short": 16, "int": 32}


def nothing(name: Name) -> None:
    """The lookup for which no name is a constant."""
    return


def constant(expression: Expression, lookup: Lookup = nothing) -> Value | None:
    """The value of literals and of operators on them, or None; `lookup` may value names."""
    match expression:
        case IntLiteral(value) | BoolLiteral(value):
            return value
        case FloatLiteral(text):
            return float_value(text)
        case Paren(inner):
            return constant(inner, lookup)
        case Name():
            return lookup(expression)
        case Unary(op, operand):
            return _unary(op, constant(operand, lookup))
        case Binary():
            return _chain(expression, lookup)
        case Cast(type=type_, operand=operand):
            return _cast(type_.name, constant(operand, lookup))
        case Conditional(condition, then, otherwise):
            chosen = constant(condition, lookup)
            if not isinstance(chosen, bool):
                return None
            return constant(then if chosen else otherwise, lookup)
        case _:
            return None


def _chain(expression: Binary, lookup: Lookup) -> Value | None:
    """The value of a chain such as `a + b + c`, which nests as deep as it is long."""
    spine = [expression]
    while isinstance(spine[-1].left, Binary):
        spine.append(spine[-1].left)
    value = constant(spine[-1].left, lookup)
    for node in reversed(spine):
        value = _binary(node.operator, value, constant(node.right, lookup))
    return value


def float_value(text: str) -> float:
    """The value of a float literal as written, suffix and underscores included."""
    return float(text.replace("_", "").rstrip("fFdD"))


def single(value: float) -> float:
    """The value rounded to a float of 32 bits."""
    try:
        rounded: float = _SINGLE.unpack(_SINGLE.pack(value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)
    return rounded


def wrap(value: int, bits: int = 32) -> int:
    """The value that an integer of so many bits keeps."""
    half = 1 << (bits - 1)
    return (value + half) % (2 * half) - half


def _unary(op: str, value: Value | None) -> Value | None:
    match op, value:
        case "!", bool():
            return not value
        case _, None | bool():
            return None
        case "-", int():
            return wrap(-value)
        case "-", float():
            return -value
        case "+", _:
            return value
        case "~", int():
            return ~value
        case _:
            return None


def _cast(name: str, value: Value | None) -> Value | None:
    if value is None or isinstance(value, bool):
        return value if name == "boolean" else None
    if name in _BITS:
        return wrap(int(value), _BITS[name]) if abs(value) < 2**63 else None
    return float(value) if name in ("float", "double") else None


def _binary(op: str, left: Value | None, right: Value | None) -> Value | None:
    if (op == "&&" and left is False) or (op == "||" and left is True):
        return left
    if left is None or right is None:
        return None
    if isinstance(left, bool) != isinstance(right, bool):
        return None
    if isinstance(left, bool) and isinstance(right, bool):
        return _BOOLEAN[op](left, right) if op in _BOOLEAN else None
    if op in _COMPARISON:
        return bool(_COMPARISON[op](left, right))
    if isinstance(left, int) and isinstance(right, int):
        return _integers(op, left, right)
    return _floats(op, float(left), float(right))


def _integers(op: str, left: int, right: int) -> int | None:
    if op in ("/", "%"):
        if right == 0:
            return None
        quotient = abs(left) // abs(right) * (1 if (left < 0) == (right < 0) else -1)
        return wrap(quotient if op == "/" else left - quotient * right)
    if op in ("<<", ">>"):
        shift = left << (right & 31) if op == "<<" else left >> (right & 31)
        return wrap(shift)
    return wrap(_ARITHMETIC[op](left, right)) if op in _ARITHMETIC else None


def _floats(op: str, left: float, right: float) -> float | None:
    if op == "/":
        return left / right if right else None
    return float(_ARITHMETIC[op](left, right)) if op in ("+", "-", "*") else None


_BOOLEAN: dict[str, Callable[[bool, bool], bool]] = {
    "&&": operator.and_,
    "||": operator.or_,
    "&": operator.and_,
    "|": operator.or_,
    "^": operator.xor,
    "==": operator.eq,
    "!=": operator.ne,
}
_COMPARISON: dict[str, Callable[[Value, Value], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}
_ARITHMETIC: dict[str, Callable[..., int]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "&": operator.and_,
    "|": operator.or_,
    "^": operator.xor,
}
