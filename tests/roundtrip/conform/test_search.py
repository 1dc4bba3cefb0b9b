"""Runs of drawn models conform; with a fault they do if and only if they are runs all the same."""

from __future__ import annotations

from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync.roundtrip.conform.graph import StateGraph
from rebsync.roundtrip.conform.recording import Event, Served
from rebsync.roundtrip.conform.search import Search, SearchResult
from rebsync.roundtrip.conform.starts import Start, modes, start
from rebsync.roundtrip.conform.stream import Stream
from tests.checker.draw_outlines import Features
from tests.checker.draw_systems import CLOCKED, REAL, TIMED, WITHOUT_DELAY, systems
from tests.roundtrip.conform import simulated
from tests.roundtrip.conform.faults import some
from tests.roundtrip.conform.oracle import TooMany, is_run

FAMILIES: dict[str, Features] = {
    "exact": TIMED,
    "without delay": WITHOUT_DELAY,
    "clock": CLOCKED,
    "real numbers": REAL,
}
LONG = 20  # steps
SOME = min(settings().max_examples, 20)  # drawing a model takes long
UNTIL = 40
WIDE = 1000  # possible states at one moment: more take long


def search(model: simulated.Given, run: list[Served]) -> tuple[Start, SearchResult | None]:
    """What the search finds in a recording with these steps."""
    graph = StateGraph(model.program, model.observable)
    stream = Stream(iter(run), len(model.program.rebecs), _ignored)
    begun = start(graph, stream, modes(graph, stream)[0], 2000)
    if not begun.configs:
        return begun, None
    return begun, Search(graph, stream, limit=WIDE).run(begun.configs, begun.time)


def _ignored(_: Event) -> None:
    return


@pytest.mark.parametrize("family", FAMILIES)
@settings(max_examples=SOME)
@given(data=st.data())
def test_runs_of_drawn_models_conform(family: str, data: st.DataObject) -> None:
    model = simulated.given(data.draw(systems(FAMILIES[family])).model)
    run = simulated.simulate(model, data.draw(st.integers(0, 999)), LONG, UNTIL)
    assume(run)
    begun, found = search(model, run)
    assert found is not None
    assume(found.verdict != "cut")
    assert (found.verdict, found.compared) == ("fits", len(run)), begun


@pytest.mark.parametrize("family", FAMILIES)
@settings(max_examples=SOME)
@given(data=st.data())
def test_runs_with_a_fault_conform_if_they_are_runs(family: str, data: st.DataObject) -> None:
    model = simulated.given(data.draw(systems(FAMILIES[family])).model)
    seed = data.draw(st.integers(0, 999))
    run = simulated.simulate(model, seed, LONG, UNTIL)
    assume(run)
    fault, at, faulty = some(run, Random(seed))
    begun, found = search(model, faulty)
    assume(not begun.is_middle and not begun.missing)
    try:
        expected = is_run(model, faulty)
    except TooMany:
        assume(False)
    assume(found is None or found.verdict != "cut")
    assert (found is not None and found.verdict == "fits") is expected, (fault, at)


@pytest.mark.parametrize("family", ["exact", "without delay"])
@settings(max_examples=SOME)
@given(data=st.data())
def test_the_rest_of_a_run_conforms(family: str, data: st.DataObject) -> None:
    model = simulated.given(data.draw(systems(FAMILIES[family])).model)
    run = simulated.simulate(model, data.draw(st.integers(0, 999)), LONG, UNTIL)
    assume(len(run) > 3)
    rest = run[data.draw(st.integers(1, len(run) - 1)) :]
    begun, found = search(model, rest)
    assume(begun.is_whole)
    assert found is not None
    assume(found.verdict != "cut")
    assert found.verdict == "fits"
