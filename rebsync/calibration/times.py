"""What a recorded run took, by the places of its model; all times in units of the model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import median
from typing import Literal, TypeAlias

from rebsync.records import dataclass
from rebsync.source import Span

Kind: TypeAlias = Literal["delay", "after", "deadline", "period"]


@dataclass(frozen=True, slots=True)
class TimeSite:
    """A time in a model: what kind, its expression, and the server or method that it is in."""

    kind: Kind
    span: Span
    line: int
    text: str
    body: str


@dataclass(frozen=True, slots=True)
class Sample:
    """One time that was measured: `model` says what it is in the model, `measured` what it took.

    `late` is by how much the body ended after its model time.
    """

    model: int
    measured: float
    late: float

    @property
    def excess(self) -> float:
        """What it took more than in the model."""
        return self.measured - self.model


@dataclass(frozen=True, slots=True)
class Statistics:
    """Least, median, 99 % and greatest of some numbers."""

    count: int
    least: float
    median: float
    most: float  # of 99 %
    greatest: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Statistics | None:
        """Of some numbers; None of none."""
        if not values:
            return None
        inorder = sorted(values)
        return cls(len(inorder), inorder[0], median(inorder), quantile(inorder, 0.99), inorder[-1])


def quantile(inorder: Sequence[float], share: float) -> float:
    """The least of some numbers below which is so large a share of them."""
    return inorder[max(math.ceil(share * len(inorder)) - 1, 0)]


@dataclass(frozen=True, slots=True)
class Measured:
    """A place of the model with what was measured there.

    `shared` are the lines of other delays that ran in the same bodies: what these took beyond the
    model is counted for each of them. `shortened` counts the delays that say nothing: a body that
    begins late waits only for what is left.
    """

    site: TimeSite
    samples: tuple[Sample, ...]
    shared: tuple[int, ...] = ()
    shortened: int = 0

    @property
    def statistics(self) -> Statistics | None:
        """Of the times that were measured."""
        return Statistics.of([sample.measured for sample in self.samples])

    @property
    def model(self) -> tuple[int, ...]:
        """The values that it had in the model."""
        return tuple(sorted({sample.model for sample in self.samples}))


@dataclass(frozen=True, slots=True)
class Slow:
    """A body that takes time although it has no delay, which no place of the model stands for."""

    body: str
    line: int
    samples: tuple[Sample, ...]


@dataclass(frozen=True, slots=True)
class RunTimes:
    """All that was measured.

    `latency` is what bodies without a delay take, 99 % of them, but no more than `slack`: what the
    middleware and the machine take of every body. `bodies` were recorded; of `unknown` of them the
    model does not say, or not for certain, what they ran.
    """

    places: tuple[Measured, ...]
    slow: tuple[Slow, ...]
    latency: float
    slack: float
    time_unit: float
    bodies: int
    unknown: int
