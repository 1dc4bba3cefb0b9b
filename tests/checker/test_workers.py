"""Several threads search as one does: number for number, run for run, wherever the search ends.

With little room, rounds are begun on levels of two states, have seven, and are cut anywhere.
"""

from __future__ import annotations

import shutil
import time
from contextlib import suppress
from dataclasses import astuple, replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync.checker.compiled import CompiledSearch
from rebsync.checker.exploration import Covered, Exploration, Faults, Limits, Progress, Search
from rebsync.checker.lowering import lower
from rebsync.checker.problem import Options, Problem
from rebsync.checker.reduction import persistent_sets
from rebsync.checker.search import FIRST, Interpreted
from rebsync.checker.steps import Semantics
from rebsync.checker.symmetry import symmetry_of
from rebsync.diagnostics import RebsyncError
from rebsync.model import Binary, Member, Name
from rebsync.properties import Measure
from tests.checker.comparing import System, little_room
from tests.checker.draw_networks import networks
from tests.checker.draw_systems import Drawn, systems
from tests.checker.test_compiled import walkers
from tests.checker.test_engines import FAMILIES
from tests.checker.test_models import Expected, read, rows

pytestmark = pytest.mark.skipif(
    not any(map(shutil.which, ("cc", "gcc", "clang"))), reason="no C compiler"
)
_NOTHING = Covered(frozenset(), frozenset(), ())
_FEW = settings(max_examples=max(6, settings().max_examples // 10))  # each is compiled


def _figures(found: Exploration) -> tuple[object, ...]:
    """All that is found. Of a search that ends at the first violation, steps may have been made
    ahead, and have run bodies, with one thread as with several."""
    told = replace(found, engine="", seconds=0.0, build_seconds=0.0, memory=0, notes=())
    return astuple(replace(told, covered=_NOTHING) if found.reason == FIRST else told)


def _same(one: Search, other: Search, limits: Limits) -> Exploration:
    """Both searches find the same within the limits: figures, runs, and steps."""
    found = one.run(limits)
    assert _figures(other.run(limits)) == _figures(found)
    for state in range(0, found.states, 1 + found.states // 50):
        assert other.path(state) == one.path(state)
    if found.reason != FIRST:
        assert astuple(other.graph()) == astuple(one.graph())
    return found


def _compare(system: System, view: Semantics, workers: int, until: int | None = None) -> None:
    """All of a system, cut at a state, at its first violation, and with less to search."""
    program, invariants = system.program, system.invariants()

    def pair(**reduced: object) -> tuple[Search, Search]:
        return (
            Interpreted(program, view, invariants, **reduced),  # type: ignore[arg-type]
            CompiledSearch(program, view, invariants, workers=workers, **reduced),  # type: ignore[arg-type]
        )

    limits = Limits(until=until, states=2000)
    found = _same(*pair(), limits)
    _same(*pair(), replace(limits, states=1 + found.states // 2))
    _same(*pair(persistent=persistent_sets(program, view)), limits)
    faults = Faults(frozenset(invariants), deadlock=False)
    _same(*pair(), replace(limits, first=True, faults=faults))
    problem = Problem(system.source, system.analysis, system.properties)
    with suppress(RebsyncError):  # has none
        symmetry = symmetry_of(program, problem, Options(view, symmetry=True))
        alone = CompiledSearch(program, view, invariants, symmetry=symmetry)
        _same(alone, pair(symmetry=symmetry)[1], limits)


@pytest.mark.parametrize("workers", [2, 3])
@rows
def test_on_every_model(row: Expected, workers: int) -> None:
    with little_room():
        _compare(read(row.model), row.view, workers)


@pytest.mark.parametrize("family", FAMILIES)
@_FEW
@given(data=st.data(), workers=st.integers(2, 4))
def test_on_drawn_systems(family: str, data: st.DataObject, workers: int) -> None:
    features, view = FAMILIES[family]
    drawn = data.draw(systems(features))
    with little_room():
        system = System.of(drawn.model, drawn.properties)
        _compare(system, view, workers, 12 if features.clock else None)


@_FEW
@given(drawn=networks(), workers=st.integers(2, 4))
def test_on_drawn_networks(drawn: Drawn, workers: int) -> None:
    with little_room():
        _compare(System.of(drawn.model, drawn.properties), "tts", workers)


# --- many states ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "limits",
    [
        Limits(states=60_000),
        Limits(until=9),
        Limits(first=True, faults=Faults(frozenset({0}))),
    ],
)
def test_many_states(limits: Limits) -> None:
    program = walkers(3, 150).program
    alone, together = (CompiledSearch(program, "ftts", (0,), workers=workers) for workers in (1, 3))
    found = alone.run(limits)
    assert _figures(together.run(limits)) == _figures(found)
    for state in range(0, found.states, 1000):
        assert together.path(state) == alone.path(state)


CHOOSER = """\
reactiveclass Chooser(3) {
    statevars { int chosen; int told; int large; int small; int gap; }
    Chooser() { gap = 1; self.choose(); }
    msgsrv choose() { chosen = ?(1, 2, 3, 4, 5, 6, 7); self.tell(); }
    msgsrv tell() {
        told = chosen;
        if (told > 1) { large = 1; small = -1; }
        gap = told - 3;
    }
}
main { Chooser c():(); }
"""


def test_what_is_wrong_is_told_in_one_order() -> None:
    """In one round seven states are expanded, and each has an event of its own."""
    asked = "".join(f" p{n}: c.told != {n};" for n in range(1, 8))
    system = System.of(CHOOSER, f"property {{ Assertion {{{asked} }} }}")
    with little_room():
        search = CompiledSearch(system.program, "tts", system.invariants(), workers=3)
    events = search.run(Limits()).events
    assert [e.cause for e in events] == [0, "deadlock", 1, 2, 3, 4, 5, 6]


def test_values_are_those_of_the_first_states() -> None:
    """The extremes are met by several threads in one round."""
    system = System.of(CHOOSER)
    large, small, told, gap = (Member(Name("c"), n) for n in ("large", "small", "told", "gap"))
    asked = tuple(Measure("", value) for value in (large, small, Binary("/", told, gap)))
    program = lower(system.analysis, system.properties, measures=asked)[0]
    expected = Interpreted(program, "tts").run(Limits()).measured
    assert expected[2].undefined > 0
    for _ in range(5):  # which thread meets which state is chance
        with little_room():
            search = CompiledSearch(program, "tts", workers=3)
        assert search.run(Limits()).measured == expected


COUNTER = """\
reactiveclass Counter(2) {
    statevars { int count; int chosen; }
    Counter() { self.next(); }
    msgsrv next() {
        chosen = ?(1, 2, 3);
        count = count + 1;
        if (count < 100) { self.next() after(1); }
    }
}
reactiveclass Idle(2) { Idle() { } }
main {
    Counter counter():();
%IDLE%
}
"""


@pytest.mark.parametrize("limits", [Limits(), Limits(until=50)])
def test_states_that_outgrow_their_words(limits: Limits) -> None:
    """Thirty-two rebecs have 2 bits each at first; when one counts on, all states move."""
    idle = "\n".join(f"    Idle i{n}():();" for n in range(31))
    program = System.of(COUNTER.replace("%IDLE%", idle)).program
    with little_room():
        together = CompiledSearch(program, "tts", workers=2)
    found = _same(Interpreted(program, "tts"), together, limits)
    assert (found.reason is None) == (limits.until is None)


LONG = COUNTER.replace("%IDLE%", "").replace(
    "count = count + 1;",
    "count = count + 1; if (count == 20) { int i = 0; while (chosen == 2 && i < %MOST%) { i++; } }",
)


def test_a_body_that_is_given_up_ends_it_where_it_ends_one_thread() -> None:
    program = System.of(LONG.replace("%MOST%", "100000")).program
    limits = Limits(instructions=50_000)
    with little_room():
        alone, together = (CompiledSearch(program, "tts", workers=n) for n in (1, 3))
    found = alone.run(limits)
    assert found.cut
    assert _figures(together.run(limits)) == _figures(found)
    assert _figures(together.run(Limits())) == _figures(alone.run(Limits()))


def test_a_thread_in_a_long_step_is_ended() -> None:
    program = System.of(LONG.replace("%MOST%", "2000000000")).program
    with little_room():
        search = CompiledSearch(program, "tts", workers=3)
    began = time.monotonic()
    found = search.run(Limits(seconds=0.5, instructions=10**10))
    assert found.reason == "the bound of 0.5 seconds was reached"
    assert time.monotonic() < began + 5
    assert len(search.path(found.states - 1)) == found.depth + 1


def test_it_goes_on_where_it_stopped() -> None:
    program = walkers(3, 60).program
    pieces, whole = (CompiledSearch(program, "ftts", workers=workers) for workers in (2, 1))
    for states in range(3, 9000, 701):
        reason = pieces.run(Limits(states=states)).reason
        assert reason == f"the bound of {states} states was reached"
    assert _figures(pieces.run(Limits(states=20_000))) == _figures(whole.run(Limits(states=20_000)))


def test_seconds_memory_and_interrupts() -> None:
    search = CompiledSearch(walkers(8, 40).program, "ftts", workers=2)
    seen: list[Progress] = []
    reason = search.run(Limits(seconds=0.2), seen.append).reason
    assert reason == "the bound of 0.2 seconds was reached"
    assert seen[-1].states > seen[0].states > 0
    assert search.run(Limits(memory=1)).reason == "the bound of 1 bytes of memory was reached"

    def interrupt(_: Progress) -> None:
        raise KeyboardInterrupt

    found = search.run(Limits(), interrupt)
    assert found.reason == "it was interrupted"
    assert len(search.path(found.states - 1)) == found.depth + 1
