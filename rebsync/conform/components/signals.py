"""Truth over real time, as far as it is known, and temporal operators on it.

Boolean signals of Maler and Nickovic (Monitoring temporal properties of continuous signals, 2004),
with a third value: when it is not known. So what comes out is true, or false, of every run that may
have been.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import inf

from rebsync.records import dataclass

Intervals = tuple[tuple[float, float], ...]
"""Open intervals, disjoint, in their order."""


@dataclass(frozen=True, slots=True)
class Signal:
    """When something is surely true, and when it is surely false."""

    true: Intervals
    false: Intervals

    def negated(self) -> Signal:
        """Its negation."""
        return Signal(self.false, self.true)

    def both(self, other: Signal) -> Signal:
        """The conjunction."""
        return Signal(common(self.true, other.true), united((*self.false, *other.false)))

    def either(self, other: Signal) -> Signal:
        """The disjunction."""
        return self.negated().both(other.negated()).negated()

    def eventually(self, low: float, high: float) -> Signal:
        """Whether it is true at some time between `low` and `high` from now."""
        if high < max(low, 0.0):
            return Signal((), ((-inf, inf),))
        true = united((start - high, end - low) for start, end in self.true)
        false = ((start - low, end if end == inf else end - high) for start, end in self.false)
        return Signal(true, united(each for each in false if each[0] < each[1]))

    def until(self, either: Signal, high: float) -> Signal:
        """Whether it is true by `high` from now, and `either` (it, or what has to hold) until then.

        It is false, too, if `either` is before it is true.
        """
        if high < 0:
            return Signal((), ((-inf, inf),))
        true = (
            (max(until[0], now[0] - high), min(until[1], now[1]))
            for now, until in _overlaps(self.true, either.true)
        )
        stopped = (
            (not_yet[0], min(not_yet[1], stop[1]))
            for not_yet, stop in _overlaps(self.false, either.false)
        )
        return Signal(united(true), united((*self.eventually(0.0, high).false, *stopped)))


def united(intervals: Iterable[tuple[float, float]]) -> Intervals:
    """The union."""
    found: list[tuple[float, float]] = []
    for start, end in sorted(intervals):
        if found and start < found[-1][1]:
            found[-1] = found[-1][0], max(end, found[-1][1])
        else:
            found.append((start, end))
    return tuple(found)


def common(one: Intervals, other: Intervals) -> Intervals:
    """The intersection."""
    return tuple((max(a[0], b[0]), min(a[1], b[1])) for a, b in _overlaps(one, other))


def _overlaps(
    one: Intervals, other: Intervals
) -> Iterator[tuple[tuple[float, float], tuple[float, float]]]:
    first, second = 0, 0
    while first < len(one) and second < len(other):
        a, b = one[first], other[second]
        if max(a[0], b[0]) < min(a[1], b[1]):
            yield a, b
        if a[1] < b[1]:
            first += 1
        else:
            second += 1
