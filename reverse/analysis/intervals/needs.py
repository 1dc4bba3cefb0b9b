"""What must hold of expressions, so that the model means what the code does."""

from __future__ import annotations

from typing import TypeAlias

from rebsync import model as m
from rebsync.intervals import Interval
from rebsync.records import dataclass

# Where an expression stands, and what for its value must be within bounds.
Mark: TypeAlias = tuple[str, int, int, str]


@dataclass(frozen=True, slots=True)
class Need:
    """An expression whose value must be within bounds; `mark` is where and what for."""

    expression: m.Expression
    bounds: Interval
    mark: Mark
