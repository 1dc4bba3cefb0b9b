"""Monte Carlo simulation: what an expression is on many runs by chance.

Every possible step is as likely as any other, so what is estimated is of that choice: a model says
what may happen, not how often. Means have confidence intervals by the central limit theorem; of
truth values, the share that is true has that of Wilson (1927), which holds near 0 and 1 too.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import sqrt
from statistics import NormalDist, fmean, stdev
from typing import Literal, TypeAlias

from rebsync.checker.endless import EndlessBody
from rebsync.checker.machine import Failed
from rebsync.checker.program import Program
from rebsync.checker.search import Interpreted
from rebsync.checker.simulate import by_chance, walk
from rebsync.checker.state import State
from rebsync.checker.steps import Failure, FailureKind, Semantics
from rebsync.records import dataclass

LEVEL = 0.95  # of confidence
_QUANTILE = NormalDist().inv_cdf((1 + LEVEL) / 2)
_BINS = 20
_TOGETHER = 100  # runs

SampleEnd: TypeAlias = Literal["cut", "ended", "endless", FailureKind]


@dataclass(frozen=True, slots=True)
class SampleValues:
    """Of one run the least, the greatest and the last value of an expression in its states."""

    least: int
    greatest: int
    last: int


@dataclass(frozen=True, slots=True)
class Sample:
    """One run: how it ended, how many steps it made in how much time, and its values by measure.

    There are none where an expression has no value in any state of the run.
    """

    end: SampleEnd
    steps: int
    time: int
    values: tuple[SampleValues | None, ...]


@dataclass(frozen=True, slots=True)
class Estimate:
    """A distribution: mean with its confidence interval, quartiles, and how often which values.

    `counts` has the first and last value of each bin, and how many runs are in it. `count` runs
    had a value.
    """

    count: int
    mean: float
    interval: tuple[float, float]
    quartiles: tuple[int, ...]  # least, first quartile, median, third quartile, greatest
    counts: tuple[tuple[int, int, int], ...]


def samples(
    program: Program,
    semantics: Semantics,
    seed: int,
    runs: int,
    *,
    until: int | None = None,
    steps: int | None = None,
) -> Iterator[Sample]:
    """Runs by chance, the first one that of `seed`, each further one that of the next number."""
    search = Interpreted(program, semantics)
    for number in range(runs):
        if number % _TOGETHER == 0:  # what bodies can do is remembered, for ever
            search = Interpreted(program, semantics)
        yield _sample(search, seed + number, until, steps)


def _sample(search: Interpreted, seed: int, until: int | None, steps: int | None) -> Sample:
    measures = search.program.measures
    values: list[SampleValues | None] = [None] * len(measures)
    made = walk(search.view, by_chance(seed), until=until, steps=steps)
    number = now = 0
    state: State = ()
    try:
        for number, before, _, step in made:
            now = before + step.time
            if isinstance(step.result, Failure):
                return Sample(step.result.kind, number, now, tuple(values))
            state = step.result
            for index, body in enumerate(measures):
                values[index] = _with_state(values[index], search, state, body)
        goes_on = len(search.view.steps(state) if state else search.view.initial_states()) > 0
    except EndlessBody:
        return Sample("endless", number, now, tuple(values))
    return Sample("cut" if goes_on else "ended", number, now, tuple(values))


def _with_state(
    known: SampleValues | None, search: Interpreted, state: State, body: int
) -> SampleValues | None:
    """The values of a run so far, with one more state."""
    try:
        value = search.value(state, body)
    except Failed:
        return known
    if known is None:
        return SampleValues(value, value, value)
    return SampleValues(min(known.least, value), max(known.greatest, value), value)


# --- statistics ----------------------------------------------------------------------------------


def estimate(values: Sequence[int]) -> Estimate | None:
    """The distribution of some values; None when there are fewer than two."""
    if len(values) < 2:
        return None
    ordered = sorted(values)
    mean = fmean(ordered)
    if set(ordered) <= {0, 1}:
        interval = share(sum(ordered), len(ordered))
    else:
        half = _QUANTILE * stdev(ordered) / sqrt(len(ordered))
        interval = mean - half, mean + half
    ranks = (0, 1, 2, 3, 4)
    quartiles = tuple(ordered[rank * (len(ordered) - 1) // 4] for rank in ranks)
    return Estimate(len(ordered), mean, interval, quartiles, _bins(ordered))


def share(found: int, of: int) -> tuple[float, float]:
    """The confidence interval of a probability, when something happened so often (Wilson)."""
    z = _QUANTILE**2
    middle, half = found + z / 2, _QUANTILE * sqrt(found * (of - found) / of + z / 4)
    low, high = (middle - half) / (of + z), (middle + half) / (of + z)
    return (0.0 if found == 0 else low), (1.0 if found == of else high)


def _bins(ordered: Sequence[int]) -> tuple[tuple[int, int, int], ...]:
    """Bins of equal width, each value by itself where there are few."""
    least, greatest = ordered[0], ordered[-1]
    width = -(-(greatest - least + 1) // _BINS)
    counts: dict[int, int] = {}
    for value in ordered:
        number = (value - least) // width
        counts[number] = counts.get(number, 0) + 1
    return tuple(
        (least + number * width, min(least + (number + 1) * width - 1, greatest), count)
        for number, count in sorted(counts.items())
    )
