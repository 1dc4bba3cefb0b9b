"""Times between two events: on drawn systems those that a plain search through all runs gives."""

from __future__ import annotations

from heapq import heappop, heappush
from typing import TypeAlias

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync.checker.exploration import Limits
from rebsync.checker.lowering import lower
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


def _least(edges: Edges, ends: list[bool], start: int) -> int | None:
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


def _greatest(edges: Edges, ends: list[bool], start: int) -> int | None:
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


@settings(max_examples=40)
@given(drawn=systems(TIMED), data=st.data())
def test_times_are_those_of_all_runs(drawn: Drawn, data: st.DataObject) -> None:
    system = System.of(drawn.model)
    cells = [
        (number, slot.offset, Member(Name(rebec.name), slot.name))
        for number, rebec in enumerate(system.program.rebecs)
        for slot in rebec.state
        if slot.kind in ("int", "byte", "short") and not slot.type.dimensions
    ]
    assume(cells)
    search = Interpreted(system.program, "tts")
    assume(search.run(Limits(states=300)).reason is None)

    def event() -> tuple[Binary, list[bool]]:
        """That a variable has one of its values, and in which states it has."""
        rebec, cell, variable = data.draw(st.sampled_from(cells))
        values = [state[rebec].variables[cell] for state in search.states]
        value = data.draw(st.sampled_from(sorted(set(values))))
        assume(value >= 0)
        return Binary("==", variable, IntLiteral(value)), [each == value for each in values]

    (start, starts), (end, ends) = event(), event()
    program, _ = lower(system.analysis, between=(TimeBetween("", start, end),))
    asked = Interpreted(program, "tts")
    asked.run(Limits(states=300))
    assert asked.states == search.states
    graph, edges = asked.graph(), _edges(search)
    begun = {n for n in graph.initial if starts[n]}
    begun |= {t for s, out in enumerate(edges) for t, _ in out if starts[t] and not starts[s]}
    times = response_time(graph, 0, 1, lambda: None)
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
        state, time = run.start, 0
        for ordinal in run.ordinals:
            assert not ends[state]
            edge = graph.first[state] + ordinal
            state, time = graph.target[edge], time + graph.time[edge]
        if run.time is not None:
            assert ends[state] and time == run.time
        else:
            assert not ends[state] and (run.loop is not None or not edges[state])
