"""What is known of one until with a bound on its time, at every node and between nodes."""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.checker.formulas import Bound
from rebsync.checker.temporal.elapsed import FOREVER, NEVER
from rebsync.checker.temporal.timeline import Timeline
from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Window:
    """The elapsed times that a bound allows, both ends included."""

    low: int
    high: int

    @staticmethod
    def of(bound: Bound | None) -> Window:
        """The window of a bound; without one all times."""
        if bound is None:
            return Window(0, FOREVER - 1)
        comparison, limit = bound
        match comparison:
            case "<":
                return Window(0, max(limit, 0) - 1)
            case "<=":
                return Window(0, max(limit, -1))
            case ">":
                return Window(max(limit + 1, 0), FOREVER - 1)
            case ">=":
                return Window(max(limit, 0), FOREVER - 1)
            case _:
                return Window(limit, limit) if limit >= 0 else Window(0, -1)

    @property
    def is_open(self) -> bool:
        """Whether there is no upper end."""
        return self.high == FOREVER - 1

    def met(self, elapsed: int) -> bool:
        """Whether the time is allowed."""
        return self.low <= elapsed <= self.high

    def passed_by(self, elapsed: int, time: int) -> int | None:
        """The first allowed time after `elapsed` and before `time` more has passed."""
        found = max(self.low, elapsed + 1)
        return found if found <= min(self.high, elapsed + time - 1) else None

    def clipped(self, elapsed: int) -> int:
        """The least time that the window cannot tell from this one."""
        return min(elapsed, self.low if self.is_open else self.high + 1)


@dataclass(frozen=True, slots=True)
class Outcome:
    """An until: its operands at every node, and the times of its fulfilment (module elapsed).

    `exact` tells that these are sets of bits.
    """

    line: Timeline
    window: Window
    left: bytearray
    right: bytearray
    times: Sequence[int]
    exact: bool

    def holds(self, node: int, elapsed: int = 0) -> bool:
        """Whether it holds at a node when so much time has passed before."""
        time = self.times[node]
        if self.exact:
            return elapsed <= self.window.high and bool(time >> (self.window.high - elapsed) & 1)
        if self.window.low == 0:
            return time + elapsed <= self.window.high
        return time > NEVER and self.window.low <= time + elapsed

    def between(self, edge: int, remaining: int) -> bool:
        """Whether it holds on the way along an edge, when so much of its time remains."""
        node = self.line.source[edge]
        if self.right[node] and self.window.met(0):
            return True
        if not self.left[node]:
            return False
        waits = self.right[node] and self.window.passed_by(0, remaining) is not None
        return waits or self.holds(self.line.target[edge], remaining)
