"""What TCTL computes for all nodes of a timeline at once: in Python, as the interpreter has it.

compiled_figures.py has the same in C.
"""

from __future__ import annotations

from array import array
from bisect import bisect_left
from collections.abc import Callable
from typing import TypeAlias

from rebsync.checker.graph import Graph
from rebsync.checker.look import Look
from rebsync.checker.temporal.elapsed import earliest, exact, latest, longest, surest
from rebsync.checker.temporal.outcome import Outcome, Window
from rebsync.checker.temporal.timeline import Timeline


class Figures:
    """The figures of untils, and where they hold."""

    def timeline(self, graph: Graph, patience: int, look: Look) -> Timeline:
        """The states of a graph as a timeline."""
        return Timeline.of(graph, patience, look)

    def truth(self, graph: Graph, predicate: int) -> bytearray:
        """Where a predicate holds."""
        word, bit = divmod(predicate, 64)
        return bytearray(each >> bit & 1 for each in graph.labels[word :: graph.words])

    def earliest(self, line: Timeline, left: bytearray, right: bytearray) -> array[int]:
        """The least time at which some run is fulfilled; FOREVER if none is."""
        return earliest(line, left, right)

    def latest(self, line: Timeline, left: bytearray, right: bytearray) -> array[int]:
        """The most that a run takes until it is fulfilled first; FOREVER if some run never is."""
        return latest(line, left, right)

    def longest(self, line: Timeline, left: bytearray, right: bytearray) -> array[int]:
        """The supremum of the times at which some run is fulfilled; NEVER if none is."""
        return longest(line, left, right)

    def surest(self, line: Timeline, left: bytearray, right: bytearray) -> array[int]:
        """The least supremum of a run; NEVER if some run is not fulfilled at all."""
        return surest(line, left, right)

    def outcome(
        self, line: Timeline, window: Window, left: bytearray, right: bytearray, on_all: bool
    ) -> Outcome:
        """Decides `A(left U right)` (`on_all`) or `E(left U right)` within a window."""
        if window.low == 0:
            figure = self.latest if on_all else self.earliest
        elif window.is_open:
            figure = self.surest if on_all else self.longest
        else:
            times = exact(line, left, right, window.high, on_all)
            return Outcome(line, window, left, right, times, True)
        return Outcome(line, window, left, right, figure(line, left, right), False)

    def holding(self, outcome: Outcome) -> bytearray:
        """Where an until holds."""
        return bytearray(outcome.holds(node) for node in range(len(outcome.line)))

    def everywhere(self, outcome: Outcome) -> bytearray:
        """Where it holds; edges on which that changes are split."""
        values, line = self.holding(outcome), outcome.line
        for edge in range(len(line.target)):
            if not edge & 4095:
                line.look()
            if line.time[edge] > 1:
                value = bool(values[line.source[edge]])
                changes = []
                for remaining in _candidates(outcome, edge):
                    if not remaining & 4095:
                        line.look()
                    if outcome.between(edge, remaining) is not value:
                        value = not value
                        changes.append((remaining, value))
                if changes:
                    line.split(edge, [remaining for remaining, _ in changes])
                    values.extend(value for _, value in changes)
        return values


FindFigures: TypeAlias = Callable[[Graph, int], Figures]


def in_python(graph: Graph, patience: int) -> Figures:
    """The figures of any graph, with so much time for edges of final states."""
    return Figures()


def _candidates(outcome: Outcome, edge: int) -> list[int]:
    """Remaining times at which truth can change along an edge, in the order of the edge."""
    longest = outcome.line.time[edge] - 1
    if outcome.exact:
        return [longest, *range(min(longest - 1, outcome.window.high + 1), 0, -1)]
    last = outcome.between(edge, 1)
    if outcome.between(edge, longest) is last:
        return [longest]
    # with such a bound it changes once at most
    points = range(1, longest + 1)
    changed = bisect_left(points, True, key=lambda rest: outcome.between(edge, rest) is not last)
    return [longest, points[changed] - 1]
