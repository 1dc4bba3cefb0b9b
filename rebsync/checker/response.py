"""Response times: from when one predicate becomes true until another holds, over all runs.

The least and the greatest time are those of a shortest and of a longest path in the exact state
space, from the states in which the first predicate holds and in some state before did not (or that
are initial) to the first state at or after them in which the second one holds.
"""

from __future__ import annotations

from array import array
from collections import deque

from rebsync.checker.graph import Graph
from rebsync.checker.look import Look
from rebsync.checker.temporal.elapsed import FOREVER
from rebsync.checker.temporal.figures import FindFigures, in_python
from rebsync.checker.temporal.timeline import Timeline
from rebsync.records import dataclass

_PATIENCE = 1  # of final states, from which no run goes on: no time comes of it


@dataclass(frozen=True, slots=True)
class ResponseRun:
    """A run from state `start` by the ordinals of its steps, in so much time.

    The time is None when the second event never comes: the run then repeats after its step `loop`,
    or ends.
    """

    start: int
    ordinals: tuple[int, ...]
    time: int | None
    loop: int | None = None


@dataclass(frozen=True, slots=True)
class ResponseTime:
    """The extremes; `least` is None when the second event never comes on any run."""

    least: ResponseRun | None
    greatest: ResponseRun


def response_time(
    graph: Graph, start: int, end: int, look: Look, find: FindFigures = in_python
) -> ResponseTime | None:
    """The extremes of the time from predicate `start` to predicate `end`, by their numbers.

    None when the first never becomes true. Steps that fail are left out.
    """
    figures = find(graph, _PATIENCE)
    line = figures.timeline(graph, _PATIENCE, look)
    begins = _become_true(graph, line, figures.truth(graph, start))
    if not begins:
        return None
    everywhere, right = bytearray(b"\1") * len(line), figures.truth(graph, end)
    soonest = figures.earliest(line, everywhere, right)
    last = figures.latest(line, everywhere, right)
    first = min(begins, key=soonest.__getitem__)
    worst = max(begins, key=last.__getitem__)
    return ResponseTime(
        _quickest(graph, line, soonest, right, first) if soonest[first] < FOREVER else None,
        _quickest(graph, line, last, right, worst)
        if last[worst] < FOREVER
        else _endless(graph, line, last, worst),
    )


def _become_true(graph: Graph, line: Timeline, holds: bytearray) -> list[int]:
    """The states with a predicate that are initial or that follow one without it."""
    begins = bytearray(len(line))
    for state in graph.initial:
        begins[state] = 1
    for source, target in zip(line.source, line.target, strict=True):
        if not holds[source]:
            begins[target] = 1
    return [state for state, begun in enumerate(begins) if begun and holds[state]]


def _quickest(
    graph: Graph, line: Timeline, values: array[int], right: bytearray, start: int
) -> ResponseRun:
    """A run of the fewest steps that takes the time which a state has among the values."""
    before: dict[int, tuple[int, int]] = {start: (-1, -1)}
    waiting = deque([start])
    while not right[node := waiting.popleft()]:
        for edge in line.edges(node):
            target = line.target[edge]
            if target not in before and values[node] == line.time[edge] + values[target]:
                before[target] = node, edge
                waiting.append(target)
    ordinals = []
    while node != start:
        node, edge = before[node]
        ordinals.append(_ordinal(graph, line, edge))
    return ResponseRun(start, tuple(reversed(ordinals)), values[start])


def _endless(graph: Graph, line: Timeline, last: array[int], start: int) -> ResponseRun:
    """A run on which the second event never comes."""
    seen: dict[int, int] = {}
    ordinals: list[int] = []
    node = start
    while node not in seen:
        seen[node] = len(ordinals)
        edge = next(e for e in line.edges(node) if last[line.target[e]] == FOREVER)
        if line.step[edge] < 0:  # a final state
            return ResponseRun(start, tuple(ordinals), None)
        ordinals.append(_ordinal(graph, line, edge))
        node = line.target[edge]
    return ResponseRun(start, tuple(ordinals), None, seen[node])


def _ordinal(graph: Graph, line: Timeline, edge: int) -> int:
    return line.step[edge] - graph.first[line.source[edge]]
