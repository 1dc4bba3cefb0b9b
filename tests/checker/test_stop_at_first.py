"""The first violation ends a search: a shortest run, nothing undecided called satisfied."""

from __future__ import annotations

import shutil
from dataclasses import replace

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Exploration, Faults, Limits
from rebsync.checker.problem import EngineChoice, Options, Problem
from rebsync.checker.result import Result
from rebsync.checker.search import FIRST, Interpreted
from rebsync.checker.steps import Semantics
from rebsync.checker.verify import verify
from tests.checker.comparing import System
from tests.checker.draw_systems import TIMED, Drawn, systems

HAS_COMPILER = any(map(shutil.which, ("cc", "gcc", "clang")))
ENGINES: tuple[EngineChoice, ...] = (
    ("interpreted", "compiled") if HAS_COMPILER else ("interpreted",)
)
COUNTER = """\
reactiveclass Counter(3) {
    statevars { int x; int y; }
    Counter() { self.go(); }
    msgsrv go() {
        x = x + ?(1, 2);
        if (x > 30) { y = 10 / (x - x); }
        self.go() after(1);
    }
}
main { Counter c():(); }
"""
PROPERTIES = """\
property {
    define { low = c.x < 7; far = c.x < 20; }
    Assertion { low: low; far: far; always: c.y == 0; }
    LTL { live: G(F(c.x > 3)); bad: G(c.x < 3); }
}
"""


def answer(model: str, properties: str, options: Options) -> Result:
    system = System.of(model, properties)
    return verify(Problem(system.source, system.analysis, system.properties), options)


@pytest.mark.parametrize("engine", ENGINES)
def test_the_first_violation_ends_the_search(engine: EngineChoice) -> None:
    found = answer(COUNTER, PROPERTIES, Options(engine=engine, first=True))
    assert (found.verdict, found.reason) == ("violated", FIRST)
    assert [(v.kind, v.name, len(v.trace.steps)) for v in found.violations] == [
        ("property", "low", 5)
    ]
    assert dict(found.properties) == {
        "low": "violated",
        "far": "undetermined",
        "always": "undetermined",
        "live": "undetermined",
        "bad": "undetermined",
    }
    assert found.states < 20


@pytest.mark.parametrize("engine", ENGINES)
def test_what_is_no_violation_does_not_end_it(engine: EngineChoice) -> None:
    """A predicate of LTL that is looked at everywhere, and a deadlock that is allowed."""
    ends = COUNTER.replace("self.go() after(1);", "if (x < 9) { self.go() after(1); }")
    text = "property { LTL { some: F(10 / (c.x + 1) < 2); } }"
    allowed = frozenset({"deadlock"})
    found = answer(ends, text, Options(engine=engine, first=True, allowed=allowed))
    assert (found.verdict, found.reason) == ("satisfied", None)
    stopped = answer(ends, text, Options(engine=engine, first=True))
    assert [v.kind for v in stopped.violations] == ["deadlock"]
    assert dict(stopped.properties) == {"some": "undetermined"}


_VIEWS: tuple[Semantics, ...] = ("tts", "ftts")


@pytest.mark.parametrize("view", _VIEWS)
@settings(max_examples=12)
@given(drawn=systems(TIMED))
def test_it_is_a_shortest_of_all_violations(view: Semantics, drawn: Drawn) -> None:
    system = System.of(drawn.model, drawn.properties)
    problem = Problem(system.source, system.analysis, system.properties)
    options = Options(view, "interpreted", Limits(states=300))
    every = verify(problem, options)
    first = verify(problem, replace(options, first=True))
    met = [v for v in every.violations if v.kind != "zeno"]
    if not met:
        assert first == replace(
            every,
            seconds=first.seconds,
            search_seconds=first.search_seconds,
            peak_memory_bytes=first.peak_memory_bytes,
        )
        return
    assert first.verdict == "violated"
    assert first.reason == FIRST
    runs = {(v.kind, v.name): v.trace for v in met}
    shortest = min(len(trace.steps) for trace in runs.values())
    for violation in first.violations:
        assert runs[violation.kind, violation.name] == violation.trace
        assert len(violation.trace.steps) == shortest
    assert all(verdict != "satisfied" for _, verdict in first.properties)


@pytest.mark.skipif(not HAS_COMPILER, reason="no C compiler")
@settings(max_examples=4)
@given(drawn=systems(TIMED), compacted=st.booleans())
def test_both_engines_end_at_one_state(drawn: Drawn, compacted: bool) -> None:
    system = System.of(drawn.model, drawn.properties)
    invariants = system.invariants()
    limits = Limits(states=300, faults=Faults(frozenset(invariants[:1]), False), first=True)
    interpreted = Interpreted(system.program, "tts", invariants)
    found = interpreted.run(limits)
    assume(found.reason == FIRST)
    compiled = CompiledSearch(system.program, "tts", invariants, hash_compaction=compacted)
    assert _figures(compiled.run(limits)) == _figures(found)
    assert [compiled.path(e.state) for e in found.events if e.state >= 0] == [
        interpreted.path(e.state) for e in found.events if e.state >= 0
    ]
    graph = compiled.graph()
    assert graph == interpreted.graph() or compacted
    assert graph.first[-1] == len(graph.target)
    assert compiled.run(limits).reason == interpreted.run(limits).reason == FIRST


def _figures(found: Exploration) -> tuple[object, ...]:
    return found.states, found.transitions, found.depth, found.events, found.reason
