"""What is known of one until with a bound on its time, at every node and between nodes."""

from __future__ import annotations

from bisect import bisect_left

from rebsync.checker.formulas import Bound
from rebsync.checker.temporal.elapsed import (
    FOREVER,
    NEVER,
    earliest,
    exact,
    latest,
    longest,
    surest,
)
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
    times: list[int]
    exact: bool

    @staticmethod
    def of(
        line: Timeline, window: Window, left: bytearray, right: bytearray, on_all: bool
    ) -> Outcome:
        """Decides `A(left U right)` (`on_all`) or `E(left U right)` within a window."""
        if window.low == 0:
            times = list((latest if on_all else earliest)(line, left, right))
        elif window.is_open:
            times = list((surest if on_all else longest)(line, left, right))
        else:
            times = exact(line, left, right, window.high, on_all)
            return Outcome(line, window, left, right, times, True)
        return Outcome(line, window, left, right, times, False)

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

    def everywhere(self) -> bytearray:
        """Whether it holds, for each node; edges on which that changes are split."""
        values = bytearray(self.holds(node) for node in range(len(self.line)))
        for edge in range(len(self.line.target)):
            if not edge & 4095:
                self.line.look()
            if self.line.time[edge] > 1:
                value = bool(values[self.line.source[edge]])
                changes = []
                for remaining in self._candidates(edge):
                    if not remaining & 4095:
                        self.line.look()
                    if self.between(edge, remaining) is not value:
                        value = not value
                        changes.append((remaining, value))
                if changes:
                    self.line.split(edge, [remaining for remaining, _ in changes])
                    values.extend(value for _, value in changes)
        return values

    def _candidates(self, edge: int) -> list[int]:
        """Remaining times at which truth can change along an edge, in the order of the edge."""
        longest = self.line.time[edge] - 1
        if self.exact:
            return [longest, *range(min(longest - 1, self.window.high + 1), 0, -1)]
        last = self.between(edge, 1)
        if self.between(edge, longest) is last:
            return [longest]
        # with such a bound it changes once at most
        points = range(1, longest + 1)
        changed = bisect_left(points, True, key=lambda rest: self.between(edge, rest) is not last)
        return [longest, points[changed] - 1]
