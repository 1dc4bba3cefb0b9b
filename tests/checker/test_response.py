"""Times between two events: on drawn systems those that a plain search through all runs gives."""

from __future__ import annotations

from array import array
from dataclasses import replace
from heapq import heappop, heappush
from itertools import product
from typing import TypeAlias

from hypothesis import assume, given, settings

from rebsync.checker.exploration import Limits
from rebsync.checker.graph import Graph
from rebsync.checker.problem import EngineChoice, Options, Problem
from rebsync.checker.response import ResponseRun, response_time
from rebsync.checker.result import MeasureRange
from rebsync.checker.search import Interpreted
from rebsync.checker.steps import Failure
from rebsync.checker.verify import verify
from rebsync.model import Binary, IntLiteral, Member, Name
from rebsync.properties import Formula, Not, TimeBetween
from tests.checker.comparing import System
from tests.checker.draw_systems import TIMED, Drawn, systems
from tests.checker.temporal_graphs import in_c

Edges: TypeAlias = list[list[tuple[int, int]]]
SERVICE = """
reactiveclass Client(3) {
  knownrebecs { Service s; }
  statevars { boolean waiting; }
  Client() { self.ask(); }
  msgsrv ask() { waiting = true; s.request() after(?(1, 2)); }
  msgsrv reply() { waiting = false; self.ask() after(5); }
}
reactiveclass Service(3) {
  knownrebecs { Client c; }
  statevars { int served; }
  msgsrv request() { delay(?(1, 4)); served = 1; c.reply() after(1); }
}
main { Client c(s):(); Service s(c):(); }
"""
WAITING, SERVED = Member(Name("c"), "waiting"), Member(Name("s"), "served")


def _between(start: Formula, end: Formula, engine: EngineChoice = "interpreted") -> MeasureRange:
    system = System.of(SERVICE)
    asked = TimeBetween("", start, end)
    problem = Problem(system.source, system.analysis, between=(asked,))
    result = verify(problem, Options(engine=engine))
    assert (result.semantics, result.verdict) == ("tts", "satisfied")
    return result.measures[0]


def test_the_least_and_the_greatest_response_time() -> None:
    found = _between(WAITING, Not(WAITING))
    assert found.least is not None and found.greatest is not None
    assert (found.least.value, found.greatest.value) == (1 + 1 + 1, 2 + 4 + 1)
    for extreme in (found.least, found.greatest):
        steps = extreme.trace.steps
        waits = [dict(step.rebecs[0].variables)["waiting"] == "true" for step in steps]
        begun = max(n for n in range(len(waits)) if waits[n] and not waits[n - 1])
        assert not waits[-1] and all(waits[begun:-1])
        assert steps[-1].until - steps[begun].until == extreme.value


def test_what_never_comes_takes_for_ever() -> None:
    found = _between(WAITING, Binary("==", SERVED, IntLiteral(2)))
    assert found.least is not None and found.greatest is not None
    assert (found.least.value, found.greatest.value) == (None, None)
    assert found.greatest.trace.loop is not None


def test_what_never_begins_has_no_time() -> None:
    found = _between(Binary("==", SERVED, IntLiteral(2)), WAITING)
    assert (found.least, found.greatest) == (None, None)


# --- on drawn systems, against plain searches ----------------------------------------------------


def _edges(search: Interpreted) -> Edges:
    """Where each state leads, in what time, steps that fail left out."""
    return [
        [
            (search.numbers[step.result], step.time)
            for step in search.view.steps(state)
            if not isinstance(step.result, Failure)
        ]
        for state in search.states
    ]


def _least(edges: Edges, ends: tuple[bool, ...], start: int) -> int | None:
    """By the search of Dijkstra."""
    waiting, seen = [(0, start)], set[int]()
    while waiting:
        time, state = heappop(waiting)
        if ends[state]:
            return time
        if state not in seen:
            seen.add(state)
            for target, more in edges[state]:
                heappush(waiting, (time + more, target))
    return None


def _greatest(edges: Edges, ends: tuple[bool, ...], start: int) -> int | None:
    """By going through all runs; a circle, or an end, before the second event lasts for ever."""
    known: dict[int, int | None] = {}

    def most(state: int) -> int | None:
        if ends[state]:
            return 0
        if state not in known:
            known[state] = None  # also while its runs are gone through
            times = [(most(target), more) for target, more in edges[state]]
            if times and all(time is not None for time, _ in times):
                known[state] = max((time or 0) + more for time, more in times)
        return known[state]

    return most(start)


def _time(run: ResponseRun | None) -> int | None:
    return None if run is None else run.time


@settings(max_examples=20)
@given(drawn=systems(TIMED))
def test_times_are_those_of_all_runs(drawn: Drawn) -> None:
    """For each pair of values of variables: from when one has it to when another one has it."""
    system = System.of(drawn.model)
    search = Interpreted(system.program, "tts")
    assume(search.run(Limits(states=300)).reason is None)
    columns = zip(
        *([v for local in s for v in local.variables] for s in search.states), strict=True
    )
    values = [(column, value) for column in columns for value in sorted(set(column))]
    events = [tuple(each == value for each in column) for column, value in values]
    graph, edges = search.graph(), _edges(search)
    for starts, ends in product(events[:6], events[-6:]):
        labels = array("Q", (a | b << 1 for a, b in zip(starts, ends, strict=True)))
        _compare(replace(graph, labels=labels, words=1), edges, starts, ends)


def _compare(graph: Graph, edges: Edges, starts: tuple[bool, ...], ends: tuple[bool, ...]) -> None:
    begun = {n for n in graph.initial if starts[n]}
    begun |= {t for s, out in enumerate(edges) for t, _ in out if starts[t] and not starts[s]}
    times = response_time(graph, 0, 1, lambda: None)
    assert response_time(graph, 0, 1, lambda: None, in_c()) == times
    if not begun:
        assert times is None
        return
    assert times is not None
    possible = [time for n in begun if (time := _least(edges, ends, n)) is not None]
    assert _time(times.least) == (min(possible) if possible else None)
    greatest = [_greatest(edges, ends, state) for state in begun]
    bounded = [time for time in greatest if time is not None]
    assert times.greatest.time == (max(bounded) if len(bounded) == len(greatest) else None)
    for run in filter(None, (times.least, times.greatest)):
        _replay(graph, run, ends)


def _replay(graph: Graph, run: ResponseRun, ends: tuple[bool, ...]) -> None:
    states, time = [run.start], 0
    for ordinal in run.ordinals:
        assert not ends[states[-1]]
        edge = graph.first[states[-1]] + ordinal
        states.append(graph.target[edge])
        time += graph.time[edge]
    last = states[-1]
    if run.time is not None:
        assert ends[last] and time == run.time
    elif run.loop is not None:
        assert not ends[last]
        assert states[run.loop] == last and run.loop < len(run.ordinals)
    else:
        assert not ends[last]
        assert all(t < 0 for t in graph.target[graph.first[last] : graph.first[last + 1]])
