"""Reads `@Move(X+1, Y)`: by how much a robot moves along each axis."""

from __future__ import annotations

from rebsync.model import Annotation, Binary, Expression, Name
from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Offset:
    """By how much one coordinate changes: not at all without an amount."""

    operator: str = "+"
    amount: Expression | None = None


@dataclass(frozen=True, slots=True)
class Movement:
    """A step of a robot, in cells along X and Y."""

    x: Offset
    y: Offset


def movement(annotation: Annotation) -> Movement | None:
    """The step that a `@Move` stands for, or None when it is not of the right form."""
    arguments = annotation.arguments or ()
    if len(arguments) != 2:
        return None
    x, y = _offset(arguments[0], "X"), _offset(arguments[1], "Y")
    return Movement(x, y) if x is not None and y is not None else None


def _offset(argument: Expression, axis: str) -> Offset | None:
    match argument:
        case Name(name) if name == axis:
            return Offset()
        case Binary("+" | "-" as operator, Name(name), amount) if name == axis:
            return Offset(operator, amount)
        case _:
            return None
