"""In which intervals the integers of an expression lie, as Python computes them: unbounded."""

from __future__ import annotations

from collections.abc import Callable

from rebsync import model as m
from rebsync.intervals import INT32, INTEGERS, Interval, exactly, of_binary, of_unary

TypeOf = Callable[[m.Expression], "m.Type | None"]

_SUMS = frozenset({"+", "-", "*", "&", "|", "^"})
_MOST = 31  # the largest distance of a shift


def value_range(expression: m.Expression, type_of: TypeOf) -> Interval:
    """What Python makes of an expression of integers, before it is wrapped."""
    match expression:
        case m.IntLiteral(value):
            return exactly(value)
        case m.Paren(inner):
            return value_range(inner, type_of)
        case m.Unary("-" | "+" | "~" as operator, operand):
            return of_unary(operator, value_range(operand, type_of))
        case m.Conditional(then=then, otherwise=otherwise):
            return value_range(then, type_of).join(value_range(otherwise, type_of))
        case m.Binary(operator, left, right) if operator in _SUMS or (
            operator == "<<" and is_distance(right)
        ):
            return of_binary(operator, value_range(left, type_of), value_range(right, type_of))
        case m.Binary():
            return INT32
        case _:
            type_ = type_of(expression)
            return INTEGERS.get(type_.name, INT32) if type_ is not None else INT32


def fits(values: Interval, name: str) -> bool:
    """Whether all the values are ones of an integer type."""
    return INTEGERS[name].includes(values)


def is_distance(expression: m.Expression) -> bool:
    """Whether a distance to shift by is a literal that Python takes as the model does."""
    return isinstance(expression, m.IntLiteral) and 0 <= expression.value <= _MOST
