"""Between which bounds the integers of an expression lie, as Python computes them: unbounded."""

from __future__ import annotations

from collections.abc import Callable

from rebsync import model as m
from rebsync.static.types import INT_MAX, INT_MIN

Range = tuple[int, int]
TypeOf = Callable[[m.Expression], "m.Type | None"]

BOUNDS: dict[str, Range] = {
    "byte": (-(2**7), 2**7 - 1),
    "short": (-(2**15), 2**15 - 1),
    "int": (INT_MIN, INT_MAX),
}
_MOST = 31  # the largest distance of a shift


def value_range(expression: m.Expression, type_of: TypeOf) -> Range:
    """The bounds of what Python makes of an expression of integers, before it is wrapped."""
    match expression:
        case m.IntLiteral(value):
            return value, value
        case m.Paren(inner):
            return value_range(inner, type_of)
        case m.Unary("-", operand):
            low, high = value_range(operand, type_of)
            return -high, -low
        case m.Unary("+", operand):
            return value_range(operand, type_of)
        case m.Unary("~", operand):
            low, high = value_range(operand, type_of)
            return ~high, ~low
        case m.Conditional(then=then, otherwise=otherwise):
            one, other = value_range(then, type_of), value_range(otherwise, type_of)
            return min(one[0], other[0]), max(one[1], other[1])
        case m.Binary(operator, left, right) if operator in _SUMS:
            return _SUMS[operator](value_range(left, type_of), value_range(right, type_of))
        case m.Binary("<<", left, right) if is_distance(right):
            low, high = value_range(left, type_of)
            distance = value_range(right, type_of)[0]
            return low << distance, high << distance
        case m.Binary():
            return BOUNDS["int"]
        case _:
            type_ = type_of(expression)
            return BOUNDS.get(type_.name, BOUNDS["int"]) if type_ is not None else BOUNDS["int"]


def fits(bounds: Range, name: str) -> bool:
    """Whether all the values are ones of an integer type."""
    low, high = BOUNDS[name]
    return low <= bounds[0] and bounds[1] <= high


def is_distance(expression: m.Expression) -> bool:
    """Whether a distance to shift by is a literal that Python takes as the model does."""
    return isinstance(expression, m.IntLiteral) and 0 <= expression.value <= _MOST


def _product(one: Range, other: Range) -> Range:
    ends = [a * b for a in one for b in other]
    return min(ends), max(ends)


def _bits(one: Range, other: Range) -> Range:
    """Of `&`, `|` and `^`: as many bits as the longer operand has."""
    length = max(max(abs(end), abs(~end)).bit_length() for end in (*one, *other))
    return -(1 << length), (1 << length) - 1


_SUMS: dict[str, Callable[[Range, Range], Range]] = {
    "+": lambda a, b: (a[0] + b[0], a[1] + b[1]),
    "-": lambda a, b: (a[0] - b[1], a[1] - b[0]),
    "*": _product,
    "&": _bits,
    "|": _bits,
    "^": _bits,
}
