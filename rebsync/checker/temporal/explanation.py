"""Runs that show why a formula of TCTL holds in a node, or why it does not."""

from __future__ import annotations

from array import array
from dataclasses import field, replace
from typing import TypeAlias

from rebsync.checker.formulas import And, Atom, Formula, Not, Or, Timed
from rebsync.checker.temporal.components import components
from rebsync.checker.temporal.elapsed import FOREVER
from rebsync.checker.temporal.evaluation import Evaluation
from rebsync.checker.temporal.outcome import Outcome, Window
from rebsync.records import dataclass

Point: TypeAlias = tuple[int, int]  # a node, and the time that has passed before
_SHORTEST = 50_000  # points that may be looked at for the shortest run
_EFFORT = 500_000  # and for some run


@dataclass(frozen=True, slots=True)
class Path:
    """Edges of the graph, and of a cycle after them, with the meaning that a Lasso gives them."""

    prefix: list[int] = field(default_factory=list)
    cycle: list[int] | None = None

    def after(self, edges: list[int]) -> Path:
        """The same path with a longer prefix."""
        return Path(edges + self.prefix, self.cycle)


def explain(evaluation: Evaluation, formula: Formula, node: int, wanted: bool) -> Path | None:
    """A run from a node that shows that a reduced formula is as wanted; None if no run can.

    It is so: the caller has found out.
    """
    match formula:
        case Atom():
            return Path()
        case Not(operand):
            return explain(evaluation, operand, node, not wanted)
        case And(left, right) | Or(left, right):
            if isinstance(formula, And) is wanted:
                return _both(evaluation, left, right, node, wanted)
            return _either(evaluation, left, right, node, wanted)
        case Timed("EF" | "EU") if wanted:
            return _fulfilled(evaluation, formula, node)
        case Timed("AF" | "AU") if not wanted:
            return _missed(evaluation, formula, node)
        case _:
            return None


def _both(
    evaluation: Evaluation, left: Formula, right: Formula, node: int, wanted: bool
) -> Path | None:
    """One run cannot show two facts about the future; a fact about the node needs no run."""
    timed = [each for each in (left, right) if _is_timed(each)]
    if len(timed) > 1:
        return None
    return explain(evaluation, timed[0], node, wanted) if timed else Path()


def _either(
    evaluation: Evaluation, left: Formula, right: Formula, node: int, wanted: bool
) -> Path | None:
    for each in (left, right):
        if bool(evaluation.truth(each, splits=False)[node]) is wanted:
            found = explain(evaluation, each, node, wanted)
            if found is not None:
                return found
    return None


def _is_timed(formula: Formula) -> bool:
    match formula:
        case Not(operand):
            return _is_timed(operand)
        case And(left, right) | Or(left, right):
            return _is_timed(left) or _is_timed(right)
        case _:
            return isinstance(formula, Timed)


@dataclass(slots=True)
class _Walk:
    """Points in breadth-first order, with the point and the edge by which each was met.

    When a point is only better than another with the same node for the more time (`prefers` 1) or
    the less (-1) that has passed, it is left out unless it is better than all before.
    """

    outcome: Outcome
    prefers: int
    points: list[Point] = field(default_factory=list)
    reached_by: list[tuple[int, int]] = field(default_factory=list)
    _number: dict[Point | int, int] = field(default_factory=dict)

    def meet(self, point: Point, parent: int = -1, edge: int = -1) -> int:
        """The number of a point, or of one that is as good; added if there is none."""
        key = point[0] if self.prefers else point
        found = self._number.get(key)
        if found is not None and self.prefers * (point[1] - self.points[found][1]) <= 0:
            return found
        self._number[key] = len(self.points)
        self.points.append(point)
        self.reached_by.append((parent, edge))
        return len(self.points) - 1

    def next_point(self, point: Point, edge: int) -> Point:
        """Where an edge leads."""
        line, (_, elapsed) = self.outcome.line, point
        return line.target[edge], self.outcome.window.clipped(elapsed + line.time[edge])

    def edges_to(self, number: int) -> list[int]:
        """The edges of the timeline from the first point to another."""
        edges = []
        while number > 0:
            number, edge = self.reached_by[number]
            edges.append(edge)
        return edges[::-1]

    def steps(self, edges: list[int]) -> list[int]:
        """The edges of the graph that these begin."""
        step = self.outcome.line.step
        return [step[edge] for edge in edges if step[edge] >= 0]


def _narrowest(outcome: Outcome, node: int, wanted: bool) -> Outcome | None:
    """The same until with the bound that it keeps, or breaks, least of all; None if there is none.

    What shows it for this bound shows it for the real one, and time then hardly tells points with
    the same node apart: a walk meets them all in linear time, but finds longer runs.
    """
    time, window = outcome.times[node], outcome.window
    if outcome.exact or window == Window.of(None):
        return None
    if window.low == 0:
        return replace(outcome, window=Window(0, time if wanted else time - 1))
    if wanted and time == FOREVER:
        return None
    return replace(outcome, window=Window(time if wanted else max(time, 0) + 1, window.high))


def _fulfilled(evaluation: Evaluation, formula: Timed, start: int) -> Path | None:
    """A run on which an until is fulfilled in time, and goes on to show why its end holds.

    None: it takes too much effort to find one.
    """
    outcome = evaluation.outcome(formula)
    way = _way_to_end(outcome, start, _SHORTEST)
    if way is None:
        narrow = _narrowest(outcome, start, True) or outcome
        way = _way_to_end(narrow, start, len(outcome.line) + _EFFORT)
    if way is None:
        return None
    edges, remaining = way
    line = evaluation.line
    steps = [line.step[edge] for edge in edges if line.step[edge] >= 0]
    node = line.target[edges[-1]] if edges else start
    if remaining is not None:
        line.split(edges[-1], [remaining])
        node = len(line) - 1
    end = explain(evaluation, formula.operands[-1], node, True) or Path()
    return end.after(steps)


def _way_to_end(outcome: Outcome, start: int, effort: int) -> tuple[list[int], int | None] | None:
    """Edges to where an until is fulfilled in time, and the time that remains of the last one.

    None remains of it when that is in the node to which it leads. None: it takes more effort.
    """
    line, window, right = outcome.line, outcome.window, outcome.right
    walk = _Walk(outcome, 0 if outcome.exact else -1 if window.low == 0 else 1)
    walk.meet((start, 0))
    for number, point in enumerate(walk.points):  # grows
        if not number & 4095:
            line.look()
        node, elapsed = point
        if right[node] and window.met(elapsed):
            return walk.edges_to(number), None
        if not outcome.left[node]:
            continue
        for edge in line.edges(node):
            time = line.time[edge]
            hit = window.passed_by(elapsed, time) if right[node] else None
            if hit is not None:
                return [*walk.edges_to(number), edge], elapsed + time - hit
            after = walk.next_point(point, edge)
            if outcome.holds(*after):
                walk.meet(after, number, edge)
        if number > effort:
            return None
    raise AssertionError("no run fulfils what was found to hold")


def _missed(evaluation: Evaluation, formula: Timed, start: int) -> Path | None:
    """A run on which an until is not fulfilled in time; None: it takes too much effort."""
    outcome = evaluation.outcome(formula)
    found = _way_past(outcome, start, _SHORTEST)
    if found is None:
        narrow = _narrowest(outcome, start, False) or outcome
        found = _way_past(narrow, start, len(outcome.line) + _EFFORT)
    return found


def _way_past(outcome: Outcome, start: int, effort: int) -> Path | None:
    """A run from a node on which an until is not fulfilled in time; None: it takes more effort."""
    line, window = outcome.line, outcome.window
    walk = _Walk(outcome, 1 if window.low == 0 else 0)
    walk.meet((start, 0))
    first, target, taken = array("q", [0]), array("q"), array("q")
    for number, point in enumerate(walk.points):  # grows
        if not number & 4095:
            line.look()
        node, elapsed = point
        if elapsed > window.high or not outcome.left[node]:
            edges = walk.edges_to(number)
            stays = any(line.source[e] == line.target[e] and line.step[e] < 0 for e in edges)
            return Path(walk.steps(edges), [] if stays else None)
        for edge in line.edges(node):
            if outcome.right[node] and window.passed_by(elapsed, line.time[edge]) is not None:
                continue
            after = walk.next_point(point, edge)
            if not outcome.holds(*after):
                target.append(walk.meet(after, number, edge))
                taken.append(edge)
        first.append(len(target))
        if number > effort:
            return None
    entry, cycle = _shortest_cycle(first, target)
    return Path(
        walk.steps(walk.edges_to(entry)), walk.steps([taken[position] for position in cycle])
    )


def _shortest_cycle(first: array[int], target: array[int]) -> tuple[int, list[int]]:
    """The first node on a cycle, and the edges of a shortest cycle through it."""
    component = components(first, target)
    entry = next(
        node
        for node in range(len(component))
        if any(component[t] == component[node] for t in target[first[node] : first[node + 1]])
    )
    reached_by: dict[int, tuple[int, int]] = {}
    waiting = [entry]
    for node in waiting:  # grows
        for edge in range(first[node], first[node + 1]):
            after = target[edge]
            if after not in reached_by and component[after] == component[entry]:
                reached_by[after] = node, edge
                waiting.append(after)
        if entry in reached_by:
            break
    node, cycle = entry, list[int]()
    while not cycle or node != entry:
        node, edge = reached_by[node]
        cycle.append(edge)
    return entry, cycle[::-1]
