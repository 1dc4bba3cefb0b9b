"""A flat chain of operands and binary operators becomes a tree."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rebsync import model as m
from rebsync.precedence import BINARY


def order_chain(items: Sequence[Any]) -> m.Expression:
    """Operand, operator, operand, ... as a tree; every operator associates to the left."""
    operands: list[Any] = [items[0]]
    operators: list[str] = []
    for operator, operand in zip(items[1::2], items[2::2], strict=True):
        level = BINARY[operator]
        while operators and BINARY[operators[-1]] >= level:
            _combine(operands, operators.pop())
        operators.append(str(operator))
        operands.append(operand)
        if operator == "instanceof":  # what follows is a type, of which nothing takes a part
            _combine(operands, operators.pop())
    while operators:
        _combine(operands, operators.pop())
    return operands[0]  # type: ignore[no-any-return]


def _combine(operands: list[Any], operator: str) -> None:
    right, left = operands.pop(), operands.pop()
    span = left.span.to(right.span)
    if operator == "instanceof":
        operands.append(m.InstanceOf(left, right, span))
    else:
        operands.append(m.Binary(operator, left, right, span))
