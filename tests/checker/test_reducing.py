"""What `rebsync verify` reduces by itself, against the full search."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from unittest import mock

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync.checker import reducing, search
from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Limits, Progress, Search, Unavailable, bound_of_states
from rebsync.checker.problem import EngineChoice, Options, Problem
from rebsync.checker.result import Result
from rebsync.checker.search import Interpreted
from rebsync.checker.steps import Semantics
from rebsync.checker.verify import verify
from tests.checker.comparing import System
from tests.checker.draw_networks import networks
from tests.checker.draw_systems import EQUAL, Drawn, systems

LIMITS = Limits(states=1500)
_FEW = settings(max_examples=max(6, settings().max_examples // 5))
_DRAWN = st.one_of(networks(), networks(delays=False), systems(EQUAL))


@pytest.mark.parametrize("view", ["tts", "ftts"])
@_FEW
@given(drawn=_DRAWN)
def test_verdicts_and_lengths_of_shortest_runs_are_those_of_the_full_search(
    view: Semantics, drawn: Drawn
) -> None:
    problem = _problem(drawn.model, drawn.properties)
    full = verify(problem, Options(view, "interpreted", LIMITS))
    assume(full.reason is None)
    with mock.patch.multiple(reducing, SMALL=8, TRIAL=5, FURTHER=0):
        reduced = verify(problem, Options(view, "interpreted", LIMITS, auto_reduce=True))
    assert reduced.states <= full.states
    assert (reduced.verdict, reduced.reason) == (full.verdict, full.reason)
    assert reduced.properties == full.properties
    assert _shortest(reduced) == _shortest(full)
    if not any("counted once" in caveat for caveat in reduced.caveats):
        assert _runs(reduced) == _runs(full)


def _problem(model: str, properties: str) -> Problem:
    system = System.of(model, properties)
    return Problem(system.source, system.analysis, system.properties)


def _shortest(result: Result) -> dict[str, int]:
    """By kinds of violations how long the shortest run to one is."""
    found: dict[str, int] = {}
    for violation in result.violations:
        length = len(violation.trace.steps)
        if violation.trace.loop is None:  # a run round a cycle has no shortest
            found[violation.kind] = min(length, found.get(violation.kind, length))
    return found


def _runs(result: Result) -> Counter[tuple[str, str, int]]:
    return Counter((v.kind, v.name, len(v.trace.steps)) for v in result.violations)


# --- where it pays

STAGES = """\
reactiveclass Stage(6) {
  knownrebecs { Stage next; }
  statevars { byte done; byte taken; }
  Stage() { self.work() after(1); }
  msgsrv work() {
    done = (byte) ((done + ?(1, 2)) % 3);
    if (done == 0) { next.take() after(1); }
    self.work() after(2);
  }
  msgsrv take() { taken = (byte) ((taken + 1) % 3); }
}
main { INSTANCES }
"""
FLEET = STAGES.replace("INSTANCES", "Stage a(a):(); Stage b(b):(); Stage c(c):(); Stage d(d):();")
CHAIN = STAGES.replace("INSTANCES", "Stage a(b):(); Stage b(c):(); Stage c(d):(); Stage d(d):();")
LATE = "property { define { late = c.taken == 2; } Assertion { never: !late; } }"
ONCE = "states that differ by an exchange are counted once (24: a, b, c, d); --no-reduce counts all"
BOUND = reducing.SMALL + 1000

SMALLER = CHAIN.replace("% 3); }\n}", "% 2); }\n}")

CASES = {
    "symmetry": (FLEET, "", None, (ONCE,)),
    "persistent sets": (CHAIN, "", None, (reducing.LEFT_OUT,)),
    "persistent sets, interpreted": (SMALLER, "", None, (reducing.LEFT_OUT,)),
    "violated: all orders": (CHAIN, LATE, None, ()),
    "a bound in fewer orders": (CHAIN, "", BOUND, (reducing.LONGER,)),
}


@pytest.mark.parametrize("case", CASES)
def test_large_spaces_are_reduced(case: str) -> None:
    model, properties, bound, caveats = CASES[case]
    problem = _problem(model, properties)
    engine: EngineChoice = "interpreted" if "interpreted" in case else "compiled"
    options = Options(engine=engine, limits=Limits(bound))
    try:
        full = verify(problem, options)
    except Unavailable as unavailable:
        pytest.skip(f"no compiled engine: {unavailable}")
    reduced = verify(problem, replace(options, auto_reduce=True))
    assert reduced.caveats == caveats
    assert (reduced.verdict, reduced.reason) == (full.verdict, full.reason)
    assert (_runs(reduced), reduced.properties) == (_runs(full), full.properties)
    if caveats and not bound:
        assert reduced.states < full.states / 2


@pytest.mark.parametrize("compaction", [False, True])
def test_a_compiled_search_goes_on(compaction: bool) -> None:
    """Beyond a bound of states as if there had been none; the interpreter finds the same."""
    program = System.of(CHAIN, LATE).program
    try:
        compiled = [
            CompiledSearch(program, "tts", (0,), hash_compaction=compaction) for _ in range(2)
        ]
    except Unavailable as unavailable:
        pytest.skip(f"no compiled engine: {unavailable}")
    for states in (1, 10, 7_000, 7_001):
        assert compiled[0].run(Limits(states=states)).reason == bound_of_states(states)
    engines: tuple[Search, ...] = (*compiled, Interpreted(program, "tts", (0,)))
    found = [engine.run(Limits()) for engine in engines]
    figures = [(f.states, f.transitions, f.depth, f.events, f.covered, f.reason) for f in found]
    assert figures[0] == figures[1] == figures[2]
    (event,) = found[0].events
    assert len({engine.path(event.state) for engine in engines}) == 1


def test_who_stops_a_search_stops_it() -> None:
    """An interrupt while fewer orders are tried is no reason to go on with all."""
    states, searches = 0, 1

    def report(progress: Progress) -> None:
        nonlocal states, searches
        begins = progress.states < states
        states, searches = progress.states, searches + begins
        if begins and searches == 2:  # the first was that of all
            raise KeyboardInterrupt

    with mock.patch.object(search, "_SLICE", 0.0):
        options = Options(engine="interpreted", auto_reduce=True)
        result = verify(_problem(CHAIN, ""), options, report)
    assert (result.verdict, result.reason) == ("undetermined", "it was interrupted")


ENDLESS = """\
reactiveclass A(3) {
  A() { self.go() after(20); }
  msgsrv go() { self.never(); }
  msgsrv never() { while (true) { } }
}
reactiveclass B(3) {
  statevars { byte ticks; boolean late; }
  B() { self.tick() after(1); }
  msgsrv tick() { ticks++; late = ticks == 20; self.tick() after(1); }
}
main { A a():(); B b():(); }
"""


def test_what_is_violated_before_a_body_that_does_not_end_is_found() -> None:
    """Although a rebec that acts alone comes to that body sooner."""
    problem = _problem(ENDLESS, LATE.replace("c.taken == 2", "b.late"))
    with mock.patch.multiple(reducing, SMALL=8, TRIAL=5, FURTHER=0):
        full, reduced = (verify(problem, Options(auto_reduce=on)) for on in (False, True))
    assert reduced.verdict == full.verdict == "violated"
    assert reduced.reason == full.reason
