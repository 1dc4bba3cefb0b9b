"""The least and greatest values that a search has seen, with runs to them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from rebsync.checker.deciding import find_figures
from rebsync.checker.exploration import Extremes
from rebsync.checker.graph import Graph
from rebsync.checker.program import Program
from rebsync.checker.response import ResponseRun, ResponseTime, response_time
from rebsync.checker.result import Extreme, MeasureRange
from rebsync.checker.trace import Trace
from rebsync.checker.watch import Watch
from rebsync.properties import Measure, TimeBetween


class TraceOf(Protocol):
    """Gives the trace of a run by its ordinals."""

    def __call__(self, path: tuple[int, ...], /, *, loop: int | None) -> Trace: ...


def measure_ranges(
    measures: tuple[Measure, ...], found: tuple[Extremes, ...], run_to: Callable[[int], Trace]
) -> tuple[MeasureRange, ...]:
    """The ranges of measures; `run_to` gives a shortest run to a state."""

    def extreme(value: int, state: int) -> Extreme | None:
        return Extreme(value, run_to(state)) if state >= 0 else None

    return tuple(
        MeasureRange(
            measure.text,
            extreme(known.least, known.least_state),
            extreme(known.greatest, known.greatest_state),
            run_to(known.undefined) if known.undefined >= 0 else None,
        )
        for measure, known in zip(measures, found, strict=True)
    )


def unmeasured(measures: tuple[Measure, ...]) -> tuple[MeasureRange, ...]:
    """The ranges when no state was seen."""
    return tuple(MeasureRange(measure.text, None, None, None) for measure in measures)


def times_between(
    asked: tuple[TimeBetween, ...],
    program: Program,
    engine: str,
    graph: Graph,
    watch: Watch,
    path: Callable[[int], tuple[int, ...]],
    trace: TraceOf,
) -> tuple[MeasureRange, ...]:
    """The ranges of times between two events, which are the last predicates of the program.

    Raises Stopped when that takes too much.
    """
    predicate = len(program.predicates) - 2 * len(asked)
    find, ranges = find_figures(engine == "compiled"), []
    for each in asked:
        watch.begin(f"measuring the {each.text}")
        found = response_time(graph, predicate, predicate + 1, watch, find)
        ranges.append(_in_trace(each.text, found, path, trace))
        predicate += 2
    return tuple(ranges)


def _in_trace(
    text: str,
    found: ResponseTime | None,
    path: Callable[[int], tuple[int, ...]],
    trace: TraceOf,
) -> MeasureRange:
    """The range of a time between two events; None of it when the first never happens."""
    if found is None:
        return MeasureRange(text, None, None, None)

    def extreme(run: ResponseRun) -> Extreme:
        way = path(run.start)
        loop = None if run.loop is None else len(way) - 1 + run.loop
        return Extreme(run.time, trace((*way, *run.ordinals), loop=loop))

    greatest = extreme(found.greatest)
    least = extreme(found.least) if found.least is not None else greatest
    return MeasureRange(text, least, greatest, None)
