"""Two threads find what one finds, number for number: drawn systems, bounds, long steps."""

from __future__ import annotations

import os
import shutil
import time
from typing import Any
from unittest import mock

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Exploration, Faults, Limits, Progress
from rebsync.checker.lowering import lower
from rebsync.checker.reduction import persistent_sets
from rebsync.checker.steps import Semantics
from rebsync.model import Member, Name
from rebsync.properties import Measure
from tests.checker.comparing import System
from tests.checker.draw_networks import networks
from tests.checker.draw_systems import DRIVEN, EQUAL, TIMED, UNTIMED, Drawn, systems
from tests.checker.test_compiled import _walkers

_COMPILERS = tuple(filter(None, map(shutil.which, ("cc", "gcc", "clang"))))
# Rounds of a few states, portions of three steps, numbers that outgrow their fields.
_LITTLE_ROOM = {"CC": f"{os.environ.get('CC') or (*_COMPILERS, 'cc')[0]} -DLITTLE_ROOM"}
_DRAWN: tuple[tuple[st.SearchStrategy[Drawn], Semantics], ...] = (
    (systems(TIMED), "tts"),
    (systems(DRIVEN), "ftts"),
    (systems(EQUAL), "tts"),
    (systems(UNTIMED), "core"),
    (networks(), "tts"),
)

pytestmark = pytest.mark.skipif(not _COMPILERS, reason="no C compiler")


def _both(
    system: System, view: Semantics, *limits: Limits, is_reduced: bool = False
) -> tuple[Exploration, Exploration]:
    """What one and two threads find in the end, with `limits` one after the other."""
    persistent = persistent_sets(system.program, view) if is_reduced else ()
    known = system.program, view, system.invariants(), persistent
    one, two = (CompiledSearch(*known, threads=threads) for threads in (1, 2))
    for each in limits:
        expected, found = one.run(each), two.run(each)
        assert _figures(found) == _figures(expected)
    paths = range(0, found.states, 1 + found.states // 50)
    assert [two.path(s) for s in paths] == [one.path(s) for s in paths]
    assert two.graph() == one.graph()
    return expected, found


def _figures(found: Exploration) -> tuple[object, ...]:
    told = found.events, found.covered, found.reason, found.cut, found.measured
    return found.states, found.transitions, found.depth, *told


@pytest.mark.parametrize(("drawn", "view"), _DRAWN)
@settings(max_examples=max(4, settings().max_examples // 20))  # each is compiled
@given(data=st.data())
def test_drawn_systems(drawn: Any, view: Semantics, data: st.DataObject) -> None:  # noqa: ANN401
    each = data.draw(drawn)
    system = System.of(each.model, each.properties)
    every = Limits(states=2000)
    with mock.patch.dict(os.environ, _LITTLE_ROOM):
        found, _ = _both(system, view, every)
        _both(system, view, every, is_reduced=True)
        half = found.states // 2 + 1
        _both(system, view, *(Limits(states=n) for n in range(3, half, 1 + half // 4)), every)
        for faults in (Faults(frozenset(system.invariants()), False), Faults(frozenset(), True)):
            _both(system, view, Limits(states=2000, faults=faults, first=True))


@pytest.mark.parametrize(
    ("walkers", "size", "limits"), [(2, 60, Limits()), (3, 150, Limits(states=60_000))]
)
def test_levels_of_thousands_of_states(walkers: int, size: int, limits: Limits) -> None:
    """The second thread takes its part of the time, too."""
    began = time.process_time() - time.thread_time()
    found, _ = _both(_walkers(walkers, size), "ftts", limits)
    assert found.states >= 60_000
    assert found.events
    assert time.process_time() - time.thread_time() - began > found.seconds / 100


_LONG = """\
reactiveclass A(2) {
    statevars { int x; }
    A() { self.go(); }
    msgsrv go() {
        for (int i = 0; i < x * 1000000000; i++) { x = x ^ 0; }
        x = ?(1, 2, 3);
        self.go() after(1);
    }
}
main { A a():(); }
"""


def test_the_bound_of_time_holds_within_a_step_of_a_round() -> None:
    """Who asks for the figures meanwhile is told of the states that are stored."""
    seen: list[Progress] = []
    with mock.patch.dict(os.environ, _LITTLE_ROOM):
        search = CompiledSearch(System.of(_LONG).program, "ftts", threads=2)
    found = search.run(Limits(seconds=1.0, instructions=10**15), seen.append)
    assert found.reason == "the bound of 1 seconds was reached"
    assert {(each.states, each.depth) for each in seen} == {(4, 1)}
    assert search.run(Limits()).reason, "what was ended in the middle does not go on"


def test_what_is_taken_back_is_not_measured() -> None:
    """The counter grows with each state, beyond the bound too, which ends a search in a round."""
    system = System.of(_LONG.replace("1000000000", "0").replace("?(1", "x + ?(1"))
    measures = (Measure("a.x", Member(Name("a"), "x")),)
    program = lower(system.analysis, system.properties, measures=measures)[0]
    with mock.patch.dict(os.environ, _LITTLE_ROOM):
        for states in range(5, 30):
            one, two = (CompiledSearch(program, "ftts", threads=threads) for threads in (1, 2))
            found = two.run(Limits(states=states))
            assert _figures(found) == _figures(one.run(Limits(states=states)))
