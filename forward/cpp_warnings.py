"""Warnings of the compiler that a model's own way of writing would raise.

The generated code keeps the parentheses of the model, so that it reads back as the same model;
where a compiler asks for more, the file says that it is meant so.
"""

from __future__ import annotations

from rebsync.model import (
    Assign,
    Binary,
    Expression,
    For,
    If,
    Interface,
    ReactiveClass,
    Unary,
    While,
    walk,
)
from rebsync.static.constants import constant

_BITS = frozenset({"&", "|", "^"})
_SHIFTS = frozenset({"<<", ">>"})
_SUMS = frozenset({"+", "-"})
_COMPARISONS = frozenset({"<", ">", "<=", ">=", "==", "!="})


def silenced(declaration: ReactiveClass | Interface) -> list[str]:
    """The warning options to ignore in the file of a class."""
    found = set()
    for node in walk(declaration):
        match node:
            case Binary(operator, left, right):
                found |= _of_binary(operator, left, right)
            case If(condition=Assign()) | While(condition=Assign()) | For(condition=Assign()):
                found.add("-Wparentheses")
            case _:
                pass
    return sorted(found)


def _of_binary(operator: str, left: Expression, right: Expression) -> set[str]:
    inner = {e.operator for e in (left, right) if isinstance(e, Binary)}
    found = set()
    if (
        (operator == "||" and "&&" in inner)
        or (operator in _BITS and inner & (_COMPARISONS | _SUMS | _BITS - {operator}))
        or (operator in _SHIFTS and inner & _SUMS)
        or (operator in _COMPARISONS and inner & _COMPARISONS)
    ):
        found.add("-Wparentheses")
    if operator in _COMPARISONS and isinstance(left, Unary) and left.operator == "!":
        found.add("-Wlogical-not-parentheses")
    if operator in _COMPARISONS and any(_is_wide(e) for e in (left, right)):
        found.add("-Wtype-limits")
    if operator in _COMPARISONS | {"&&", "||"} and left == right:
        found |= {"-Wtautological-compare", "-Wlogical-op"}
    return found


def _is_wide(expression: Expression) -> bool:
    """Whether an expression is a constant that no byte holds."""
    value = constant(expression)
    return isinstance(value, int) and not -128 <= value <= 127
