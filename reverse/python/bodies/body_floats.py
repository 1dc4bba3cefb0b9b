"""Floats: Python's have 64 bits, the literals of the model 32."""

from __future__ import annotations

from rebsync import model as m
from rebsync.reverse.models.building import bare, binary, cast
from rebsync.source import Span
from rebsync.static.types import DOUBLE


def doubled(operator: str, left: m.Expression, right: m.Expression, span: Span) -> m.Expression:
    """An operation of the model with 64 bits: its literals have 32."""
    if _is_literal(left) and _is_literal(right):
        left = cast(DOUBLE, left)
    return binary(operator, left, right, span)


def _is_literal(expression: m.Expression) -> bool:
    match bare(expression):
        case m.FloatLiteral():
            return True
        case m.Unary(_, operand):
            return _is_literal(operand)
        case m.Conditional(_, then, otherwise):
            return _is_literal(then) and _is_literal(otherwise)
        case m.Choice(options):
            return all(map(_is_literal, options))
        case _:
            return False


def is_zero(literal: m.FloatLiteral | m.IntLiteral) -> bool:
    """Whether a literal is 0."""
    return (
        not literal.value
        if isinstance(literal, m.IntLiteral)
        else not float(literal.text.rstrip("fFdD"))
    )
