"""The engines find what the reference finds: on drawn systems, in every view, number for number."""

from __future__ import annotations

import os
import shutil
from dataclasses import astuple
from itertools import pairwise
from unittest import mock

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Event, Exploration, Limits, Unavailable
from rebsync.checker.problem import Options, Problem
from rebsync.checker.program import Program
from rebsync.checker.reduction import PersistentSets, persistent_sets
from rebsync.checker.result import Result
from rebsync.checker.search import Interpreted
from rebsync.checker.steps import Failure, Semantics
from rebsync.checker.verify import verify
from tests.checker.comparing import System, by_engine, by_reference, findings
from tests.checker.draw_networks import networks
from tests.checker.draw_outlines import Features
from tests.checker.draw_systems import (
    CLOCKED,
    DRIVEN,
    REAL,
    TIMED,
    UNTIMED,
    WITHOUT_DELAY,
    Drawn,
    systems,
)

MOST = 300  # states of a drawn system
FAMILIES: dict[str, tuple[Features, Semantics]] = {
    "exact": (TIMED, "tts"),
    "floating": (TIMED, "ftts"),
    "exact without delay": (WITHOUT_DELAY, "tts"),
    "floating without delay": (WITHOUT_DELAY, "ftts"),
    "real numbers": (REAL, "tts"),
    "clock, exact": (CLOCKED, "tts"),
    "clock, floating": (CLOCKED, "ftts"),
    "core": (UNTIMED, "core"),
}


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data())
def test_the_interpreter_finds_what_the_reference_finds(family: str, data: st.DataObject) -> None:
    features, view = FAMILIES[family]
    drawn = data.draw(systems(features))
    system = System.of(drawn.model, drawn.properties)
    until = 12 if features.clock else None
    outcome = by_reference(system, view, MOST, until)
    assume(outcome.states <= MOST)
    search = Interpreted(system.program, view, system.invariants())
    assert by_engine(system, search, until) == findings(system, outcome)


@given(systems(WITHOUT_DELAY))
def test_without_delay_the_views_have_one_verdict(drawn: Drawn) -> None:
    system = System.of(drawn.model, drawn.properties)
    outcome = by_reference(system, "tts", MOST)
    assume(outcome.complete)
    exact, floating = (
        by_engine(system, Interpreted(system.program, view, system.invariants()))
        for view in _TIMED_VIEWS
    )
    assert (exact.failures, exact.false) == (floating.failures, floating.false)
    assert exact.deadlock == floating.deadlock
    assert exact.states >= floating.states


_TIMED_VIEWS: tuple[Semantics, ...] = ("tts", "ftts")


@pytest.mark.parametrize("view", _TIMED_VIEWS)
@given(drawn=systems(TIMED))
def test_verify_says_what_the_reference_found(view: Semantics, drawn: Drawn) -> None:
    system = System.of(drawn.model, drawn.properties)
    outcome = by_reference(system, view, MOST)
    assume(outcome.complete)
    expected = findings(system, outcome)
    problem = Problem(system.source, system.analysis, system.properties)
    result = verify(problem, Options(view, "interpreted"))
    kinds = {v.kind for v in expected.failures}
    kinds |= {"property"} if expected.false else set()
    kinds |= {"deadlock"} if expected.deadlock else set()
    kinds |= {"zeno"} if outcome.zeno else set()
    assert {violation.kind for violation in result.violations} == kinds
    assert result.verdict == ("violated" if kinds else "satisfied")
    assert {name for name, verdict in result.properties if verdict == "violated"} == expected.false


_REDUCIBLE = st.one_of(systems(DRIVEN), systems(TIMED), networks(), networks(delays=False))


@pytest.mark.parametrize("view", _TIMED_VIEWS)
@given(drawn=_REDUCIBLE)
def test_reduction_changes_nothing_that_is_told(view: Semantics, drawn: Drawn) -> None:
    """Not one property, violation, branch or bag; runs may be longer."""
    system = System.of(drawn.model, drawn.properties)
    problem = Problem(system.source, system.analysis, system.properties)
    limits = Limits(states=1000)
    full = verify(problem, Options(view, "interpreted", limits))
    assume(full.reason is None)
    reduced = verify(problem, Options(view, "interpreted", limits, reduce=True))
    assert reduced.states <= full.states
    assert _told(reduced) == _told(full)


def _told(result: Result) -> tuple[object, ...]:
    violations = {(v.kind, v.name) for v in result.violations}
    return result.verdict, result.reason, result.properties, violations, result.coverage


# --- the compiled engine against the interpreter -------------------------------------------------


def _compiled(
    program: Program,
    view: Semantics,
    invariants: tuple[int, ...],
    persistent: PersistentSets = (),
    compacted: bool = False,
) -> CompiledSearch:
    try:
        return CompiledSearch(program, view, invariants, persistent, hash_compaction=compacted)
    except Unavailable as unavailable:
        pytest.skip(f"no compiled engine: {unavailable}")


_FEW = settings(max_examples=max(6, settings().max_examples // 10))  # each is compiled


@pytest.mark.parametrize("family", FAMILIES)
@_FEW
@given(data=st.data())
def test_the_compiled_engine_finds_what_the_interpreter_finds(
    family: str, data: st.DataObject
) -> None:
    features, view = FAMILIES[family]
    _compare(data.draw(systems(features)), view, 12 if features.clock else None)


@pytest.mark.parametrize("view", _TIMED_VIEWS)
@_FEW
@given(drawn=networks())
def test_the_compiled_engine_leaves_out_what_the_interpreter_does(
    view: Semantics, drawn: Drawn
) -> None:
    _compare(drawn, view, None)


@pytest.mark.parametrize(
    ("features", "view"), [(DRIVEN, "ftts"), (DRIVEN, "tts"), (UNTIMED, "core")]
)
@_FEW
@given(data=st.data())
def test_the_compiled_engine_with_little_room(
    features: Features, view: Semantics, data: st.DataObject
) -> None:
    """Its tables are enlarged again and again, its memories forget, its batches are short."""
    compiler = os.environ.get("CC") or next(
        filter(None, map(shutil.which, ("cc", "gcc", "clang"))), "cc"
    )
    with mock.patch.dict(os.environ, CC=f"{compiler} -DLITTLE_ROOM"):
        _compare(data.draw(systems(features)), view, None)


def _compare(drawn: Drawn, view: Semantics, until: int | None) -> None:
    """Both engines on one system: all of it, cut somewhere, and with orders left out."""
    system = System.of(drawn.model, drawn.properties)
    program, invariants = system.program, system.invariants()
    limits = Limits(until=until, states=2000)
    interpreted = Interpreted(program, view, invariants)
    found = interpreted.run(limits)
    _same(program, view, interpreted, limits, found)
    cut = Limits(until=until, states=1 + found.states // 2)
    halved = Interpreted(program, view, invariants)
    _same(program, view, halved, cut, halved.run(cut))
    if persistent := persistent_sets(program, view):
        reduced = Interpreted(program, view, invariants, persistent)
        _same(program, view, reduced, limits, reduced.run(limits))


def _same(
    program: Program, view: Semantics, search: Interpreted, limits: Limits, found: Exploration
) -> None:
    """The compiled engine, with states in full and with fingerprints, on what was interpreted."""
    paths = range(0, found.states, 1 + found.states // 50)
    for compacted in (False, True):
        compiled = _compiled(program, view, search.invariants, search.persistent, compacted)
        assert _figures(compiled.run(limits)) == _figures(found)
        assert [compiled.path(s) for s in paths] == [search.path(s) for s in paths]
        assert astuple(compiled.graph()) == astuple(search.graph())


def _figures(exploration: Exploration) -> tuple[object, ...]:
    found = exploration
    return found.states, found.transitions, found.depth, found.events, found.covered, found.reason


# --- runs ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data())
def test_the_way_to_every_event_can_be_walked_and_is_shortest(
    family: str, data: st.DataObject
) -> None:
    features, view = FAMILIES[family]
    drawn = data.draw(systems(features))
    system = System.of(drawn.model, drawn.properties)
    search = Interpreted(system.program, view, system.invariants())
    exploration = search.run(Limits(states=500, until=12 if features.clock else None))
    levels = _levels(search)
    for event in exploration.events:
        _walk(search, event, levels)
    assert all(one.state <= two.state for one, two in pairwise(_by_expansion(exploration)))


def _levels(search: Interpreted) -> list[int]:
    """The distance of every state from the start."""
    graph = search.graph()
    levels = [-1] * len(graph)
    waiting = list(dict.fromkeys(graph.initial))
    for state in waiting:
        levels[state] = 0
    for state in waiting:
        for edge in range(graph.first[state], graph.first[state + 1]):
            target = graph.target[edge]
            if target >= 0 and levels[target] < 0:
                levels[target] = levels[state] + 1
                waiting.append(target)
    return levels


def _walk(search: Interpreted, event: Event, levels: list[int]) -> None:
    """Takes the steps to an event one by one, by ordinal and by action."""
    view, starts = search.view, search.view.initial_states()
    if event.state < 0:
        assert starts[event.ordinal].result == event.cause
        return
    first, *ordinals = search.path(event.state)
    assert len(ordinals) == levels[event.state]
    state = starts[first].result
    for ordinal in ordinals:
        assert not isinstance(state, Failure)
        step = view.steps(state)[ordinal]
        assert view.next_state(state, step.action) == step
        state = step.result
    assert not isinstance(state, Failure)
    assert search.numbers[state] == event.state
    match event.cause:
        case Failure():
            assert view.steps(state)[event.ordinal].result == event.cause
        case int(predicate):
            assert not search.holds(state, predicate)
        case _:
            assert view.is_deadlock(state)


def _by_expansion(exploration: Exploration) -> list[Event]:
    """The failures, which are met in the order in which states are expanded."""
    return [e for e in exploration.events if isinstance(e.cause, Failure)]
