"""Warnings of the compiler that a model's own way of writing would raise.

The generated code keeps the parentheses of the model, so that it reads back as the same model;
where a compiler asks for more, the file says that it is meant so.
"""

from __future__ import annotations

import operator
from collections.abc import Callable

from rebsync.forward.cpp_operands import bare
from rebsync.model import (
    Assign,
    Binary,
    Block,
    Expression,
    For,
    If,
    Interface,
    Method,
    ReactiveClass,
    Return,
    Type,
    Unary,
    While,
    walk,
)
from rebsync.static.constants import constant
from rebsync.static.types import INT_MAX, INT_MIN

_BITS = frozenset({"&", "|", "^"})
_SHIFTS = frozenset({"<<", ">>"})
_SUMS = frozenset({"+", "-"})
_COMPARISONS = frozenset({"<", ">", "<=", ">=", "==", "!="})

_ARITHMETIC: dict[str, Callable[[int, int], int]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "<<": lambda a, b: a << (b & 31),
}


def silenced(declaration: ReactiveClass | Interface) -> list[str]:
    """The warning options to ignore in the file of a class."""
    found = set()
    for node in walk(declaration):
        match node:
            case Binary(sign, left, right):
                found |= _of_binary(sign, left, right)
            case If(condition=Assign()) | While(condition=Assign()) | For(condition=Assign()):
                found.add("-Wparentheses")
            case Method(type=Type("byte" | "short"), body=Block() as body) if any(
                _is_wide(r.value) for r in walk(body) if isinstance(r, Return) and r.value
            ):
                found.add("-Woverflow")
            case _:
                pass
    return sorted(found)


def _of_binary(sign: str, left: Expression, right: Expression) -> set[str]:
    inner = {e.operator for e in (left, right) if isinstance(e, Binary)}
    found = set()
    if (
        (sign == "||" and "&&" in inner)
        or (sign in _BITS and inner & (_COMPARISONS | _SUMS | _BITS - {sign}))
        or (sign in _SHIFTS and inner & _SUMS)
        or (sign in _COMPARISONS and inner & _COMPARISONS)
    ):
        found.add("-Wparentheses")
    if sign == "/" and constant(right) == 0:
        found.add("-Wdiv-by-zero")
    if sign in _ARITHMETIC and _overflows(sign, constant(left), constant(right)):
        found.add("-Woverflow")
    if sign in _COMPARISONS and isinstance(left, Unary) and left.operator == "!":
        found.add("-Wlogical-not-parentheses")
    if sign in _COMPARISONS and any(_is_wide(e) for e in (left, right)):
        found.add("-Wtype-limits")
    if sign in _COMPARISONS | {"&&", "||"} and bare(left) == bare(right):
        found |= {"-Wtautological-compare", "-Wlogical-op"}
    return found


def _overflows(operator: str, left: object, right: object) -> bool:
    if not isinstance(left, int) or not isinstance(right, int):
        return False
    value = _ARITHMETIC[operator](left, right)
    return not INT_MIN <= value <= INT_MAX


def _is_wide(expression: Expression) -> bool:
    """Whether an expression is a constant that no byte holds."""
    value = constant(expression)
    return isinstance(value, int) and not -128 <= value <= 127
