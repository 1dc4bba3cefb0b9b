"""Symmetry reduction against the full search, on drawn systems with equal rebecs."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Exploration, Limits, Unavailable
from rebsync.checker.orbits import Orbits
from rebsync.checker.problem import EngineChoice, Options, Problem
from rebsync.checker.references import references_of
from rebsync.checker.result import Result, Violation
from rebsync.checker.search import Interpreted
from rebsync.checker.state import State
from rebsync.checker.steps import TIME, Failure, Semantics, Step
from rebsync.checker.symmetry import Symmetry, symmetry_of
from rebsync.checker.verify import verify
from rebsync.diagnostics import RebsyncError
from tests.checker.comparing import System
from tests.checker.draw_outlines import Features
from tests.checker.draw_systems import EQUAL, EQUAL_UNTIMED, Drawn, systems

FAMILIES: dict[str, tuple[Features, Semantics]] = {
    "exact": (EQUAL, "tts"),
    "floating": (EQUAL, "ftts"),
    "core": (EQUAL_UNTIMED, "core"),
}
LIMITS = Limits(states=1500)
_FEW = settings(max_examples=max(6, settings().max_examples // 20))
families = pytest.mark.parametrize("family", FAMILIES)


def _problem(drawn: Drawn) -> tuple[System, Problem]:
    system = System.of(drawn.model, drawn.properties)
    return system, Problem(system.source, system.analysis, system.properties)


def _symmetry(system: System, problem: Problem) -> Symmetry:
    """The symmetries of a system; a system without any is not of interest."""
    try:
        return symmetry_of(system.program, problem, Options(symmetry=True))
    except RebsyncError:
        assume(False)
        raise


@families
@_FEW
@given(data=st.data())
def test_the_steps_of_what_is_exchanged_are_the_exchanged_steps(
    family: str, data: st.DataObject
) -> None:
    """Every permutation of the group is an automorphism of the whole state space."""
    features, view = FAMILIES[family]
    system, problem = _problem(data.draw(systems(features)))
    symmetry = _symmetry(system, problem)
    search = Interpreted(system.program, view, system.invariants())
    search.run(Limits(states=100))
    orbits = Orbits(view, symmetry)
    for state in search.states:
        for turn in range(symmetry.order):
            image = orbits.image(state, turn)
            steps = Counter(_renamed(step, orbits, turn) for step in search.view.steps(state))
            assert steps == Counter(map(_shape, search.view.steps(image)))
            assert orbits.representative(image)[0] == orbits.representative(state)[0]
            for predicate in system.invariants():
                assert search.holds(state, predicate) == search.holds(image, predicate)


def _shape(step: Step) -> tuple[object, ...]:
    """A step without the slot of its message, which other names may put elsewhere in a bag."""
    return step.action.actor, step.action.choices, step.result, step.time


def _renamed(step: Step, orbits: Orbits, turn: int) -> tuple[object, ...]:
    names, result = orbits.symmetry.group[turn], step.result
    actor = step.action.actor if step.action.actor == TIME else names[step.action.actor]
    exchanged: State | Failure
    if isinstance(result, Failure):
        exchanged = replace(result, rebec=names[result.rebec])
    else:
        exchanged = orbits.image(result, turn)
    return actor, step.action.choices, exchanged, step.time


@families
@_FEW
@given(data=st.data())
def test_the_verdict_is_that_of_the_full_search(family: str, data: st.DataObject) -> None:
    features, view = FAMILIES[family]
    system, problem = _problem(data.draw(systems(features)))
    symmetry = _symmetry(system, problem)
    full = verify(problem, Options(view, "interpreted", LIMITS))
    assume(full.reason is None)
    reduced = verify(problem, Options(view, "interpreted", LIMITS, symmetry=True))
    assert _verdicts(reduced) == _verdicts(full)
    assert replace(reduced.coverage, largest_bags=()) == replace(full.coverage, largest_bags=())
    orbit_of = {rebec: orbit for orbit in symmetry.orbits for rebec in orbit}
    had = [bag for _, bag, _ in full.coverage.largest_bags]
    assert [bag for _, bag, _ in reduced.coverage.largest_bags] == [
        max(had[r] for r in orbit_of.get(rebec, (rebec,))) for rebec in range(len(had))
    ]
    search = Interpreted(system.program, view)
    search.run(LIMITS)
    orbits = Orbits(view, symmetry)
    assert reduced.states == len({orbits.representative(s)[0] for s in search.states})
    for violation in reduced.violations:  # each is one of the full search, with a run as short
        assert _name(violation) in map(_name, full.violations)
        same = [v for v in full.violations if v.kind == violation.kind]
        shortest = min(len(v.trace.steps) for v in same)
        assert len(violation.trace.steps) >= shortest


def _name(violation: Violation) -> tuple[str, str]:
    return violation.kind, violation.name


def _verdicts(result: Result) -> tuple[object, ...]:
    kinds = {violation.kind for violation in result.violations}
    return result.verdict, result.reason, result.properties, kinds


@pytest.mark.parametrize("family", ["exact", "core"])
@_FEW
@given(data=st.data())
def test_both_engines_find_the_same_orbits(family: str, data: st.DataObject) -> None:
    features, view = FAMILIES[family]
    system, problem = _problem(data.draw(systems(features)))
    symmetry = _symmetry(system, problem)
    interpreted = Interpreted(system.program, view, system.invariants(), symmetry=symmetry)
    found = interpreted.run(LIMITS)
    assume(found.reason is None)
    for compacted in (False, True):
        try:
            compiled = CompiledSearch(
                system.program,
                view,
                system.invariants(),
                symmetry=symmetry,
                hash_compaction=compacted,
            )
        except Unavailable as unavailable:
            pytest.skip(f"no compiled engine: {unavailable}")
        assert _figures(compiled.run(LIMITS)) == _figures(found)
        assert sorted(compiled.graph().time) == sorted(interpreted.graph().time)


def _figures(found: Exploration) -> tuple[object, ...]:
    kinds = {getattr(event.cause, "kind", event.cause) for event in found.events}
    covered = found.covered.servers, found.covered.branches
    return found.states, found.transitions, found.depth, kinds, covered


# --- temporal properties, and cycles of orbits ---------------------------------------------------

CARTS = """\
reactiveclass Cart(4) {
  knownrebecs { Desk desk; }
  statevars { boolean in; }
  Cart() { self.go(); }
  msgsrv go() { in = !in; desk.ask() %TIME%; }
}
reactiveclass Desk(9) {
  statevars { boolean odd; }
  msgsrv ask() { odd = !odd; ((Cart) sender).go(); }
}
main { Cart a(desk):(); Cart b(desk):(); Cart c(desk):(); Desk desk():(); }
"""
DEFINES = "define { some = a.in || b.in || c.in; all = a.in && b.in && c.in; }"


@pytest.mark.parametrize(
    ("kind", "formula", "time", "verdict"),
    [
        ("LTL", "G(F(!some))", "after(?(1, 2))", "violated"),
        ("LTL", "G(F(some))", "after(?(1, 2))", "satisfied"),
        ("LTL", "F(G(!all))", "after(1)", "violated"),
        ("TCTL", "EF(time <= 1, !some)", "after(?(1, 2))", "satisfied"),
        ("TCTL", "AG(time <= 3, some)", "after(?(1, 2))", "violated"),
        ("TCTL", "AF(time <= 1, all)", "after(?(1, 2))", "satisfied"),
        ("Assertion", "some || !some", "", "violated"),  # time stands still, for ever
    ],
)
def test_temporal_verdicts_and_cycles(kind: str, formula: str, time: str, verdict: str) -> None:
    properties = f"property {{ {DEFINES} {kind} {{ p: {formula}; }} }}"
    _, problem = _problem(Drawn(CARTS.replace("%TIME%", time), properties))
    full = verify(problem, Options("tts", "interpreted"))
    for engine in _ENGINES if verdict == "violated" else _ENGINES[:1]:
        _compare(full, verify(problem, Options("tts", engine, symmetry=True)), verdict)


_ENGINES: tuple[EngineChoice, ...] = ("interpreted", "compiled")


def _compare(full: Result, reduced: Result, verdict: str) -> None:
    """The same is said, and of a run that goes round the rebecs have their own names again."""
    assert full.verdict == reduced.verdict == verdict
    assert full.properties == reduced.properties
    assert reduced.states < full.states
    for violation in reduced.violations:
        steps, loop = violation.trace.steps, violation.trace.loop
        assert _name(violation) in map(_name, full.violations)
        if loop is not None:
            after, before = steps[-1].rebecs, steps[loop].rebecs
            assert [r.variables for r in after] == [r.variables for r in before]


SUSPENDED = """\
reactiveclass A(2) {
  knownrebecs { A other; }
  A() { self.go(); }
  A pick() { return other; }
  void wait(A whom) { int n = 1; delay(n); whom.go() after(1); }
  msgsrv go() { int n = 1; A found = pick(); wait(found); found.go() after(n); }
}
main { A a(b):(); A b(a):(); }
"""


def test_frames_hold_what_methods_gave() -> None:
    """Also of a method that is not suspended itself, and in the frame of who calls one that is."""
    program = System.of(SUSPENDED).program
    held = {
        program.body_at(pc).name: list(cells) for pc, cells in references_of(program).frames.items()
    }
    assert held == {"A.wait": [0], "A.go": [1]}
