"""Runs of drawn models conform; with a fault they do if and only if they are runs all the same."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest
from hypothesis import Phase, assume, given, settings
from hypothesis import strategies as st

from rebsync.conform.graph import StateGraph
from rebsync.conform.matching import Subject, conform
from rebsync.conform.recording import Event, Served
from rebsync.conform.search import Search, SearchResult
from rebsync.conform.starts import Start, modes, start
from rebsync.conform.stream import Stream
from rebsync.source import Source
from tests.checker.draw_outlines import Features
from tests.checker.draw_systems import CLOCKED, REAL, TIMED, WITHOUT_DELAY, systems
from tests.conform import simulated
from tests.conform.faults import some
from tests.conform.oracle import TooMany, is_run

FAMILIES: dict[str, Features] = {
    "exact": TIMED,
    "without delay": WITHOUT_DELAY,
    "clock": CLOCKED,
    "real numbers": REAL,
}
LONG = 20  # steps
WAREHOUSE = Path(__file__).parents[2] / "examples" / "warehouse" / "warehouse.rebeca"
# Drawing a model takes long; shrinking one takes longer than a test may, and the time limit then
# hides what was wrong.
DRAWN = settings(max_examples=min(settings().max_examples, 20), phases=set(Phase) - {Phase.shrink})
UNTIL = 40
WIDE = 1000  # possible states at one moment: more take long


def search(
    model: simulated.Given, run: list[Served], number: int = 0
) -> tuple[Start, SearchResult | None]:
    """What the search finds in a recording with these steps, begun in one of the possible ways."""
    graph = StateGraph(model.program, model.observable)
    stream = Stream(iter(run), len(model.program.rebecs), _ignored)
    begun = start(graph, stream, modes(graph, stream)[number], 2000)
    if not begun.configs:
        return begun, None
    return begun, Search(graph, stream, limit=WIDE).run(begun.configs, begun.time)


def ways(model: simulated.Given, run: list[Served]) -> int:
    """In how many ways a recording with these steps may begin."""
    graph = StateGraph(model.program, model.observable)
    return len(modes(graph, Stream(iter(run), len(model.program.rebecs), _ignored)))


def _ignored(_: Event) -> None:
    return


@pytest.mark.parametrize("family", FAMILIES)
@DRAWN
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
@DRAWN
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
@DRAWN
@given(data=st.data())
def test_the_rest_of_a_run_conforms(family: str, data: st.DataObject) -> None:
    model = simulated.given(data.draw(systems(FAMILIES[family])).model)
    run = simulated.simulate(model, data.draw(st.integers(0, 999)), LONG, UNTIL)
    assume(len(run) > 3)
    rest = run[data.draw(st.integers(1, len(run) - 1)) :]
    said = []
    for number in range(ways(model, rest)):
        begun, found = search(model, rest, number)
        said.append(found.verdict if found is not None else "refused")
        if not begun.is_whole or said[-1] == "cut":
            assume(False)
        if said[-1] == "fits":
            break
    assert said[-1] == "fits", said


ENDLESS = """
reactiveclass C(2) {
  statevars { byte n; }
  C() { self.go() after(3); }
  msgsrv go() { n = (byte) ((n + 1) % 3); self.go(); }
}
main { C c():(); }
"""


@pytest.mark.parametrize(
    ("wrong", "verdict"), [(0, "undetermined"), (5, "deviates")], ids=["true", "wrong state"]
)
def test_a_recording_may_begin_in_a_moment_that_does_not_end(wrong: int, verdict: str) -> None:
    model = simulated.given(ENDLESS)
    run = simulated.simulate(model, 0, 8)[4:]
    run = [step._replace(cells=(step.cells[0] + wrong,)) for step in run]
    subject = Subject(Source("model.rebeca", ENDLESS), model.program, model.observable)
    found = conform(subject, simulated.Recorded(tuple(run)))
    assert (found.verdict, found.compared) == (verdict, 0)


HIDDEN_CHOICES = """
reactiveclass C(2) {
  statevars { int n; }
  C() { self.choose(); }
  msgsrv choose() { self.show(?(1, 2, 3, 4, 5)) after(1); }
  msgsrv show(int chosen) { n = chosen; }
}
main { C a():(); C b():(); C c():(); }
"""


@pytest.mark.parametrize(("limit", "verdict"), [(60, "cut"), (300, "fits")])
def test_a_search_is_cut_at_its_limit(limit: int, verdict: str) -> None:
    """Until the choices of three rebecs show, 125 states are possible."""
    model = simulated.given(HIDDEN_CHOICES)
    run = simulated.simulate(model, 1)
    graph = StateGraph(model.program, model.observable)
    stream = Stream(iter(run), 3, _ignored)
    begun = start(graph, stream, "constructors")
    found = Search(graph, stream, limit=limit).run(begun.configs)
    assert found.verdict == verdict
    if verdict == "cut":
        assert found.widest == limit + 1
        assert found.compared <= 6  # what was served before it shows what was chosen
        assert found.reason == "more than 60 states of the model are possible"
    else:
        assert (found.compared, found.widest >= 125) == (len(run), True)


def test_what_is_cut_is_undetermined() -> None:
    model = simulated.given(HIDDEN_CHOICES)
    run = simulated.simulate(model, 1)
    wrong = [*run[:-1], run[-1]._replace(cells=(7,))]
    subject = Subject(Source("model.rebeca", HIDDEN_CHOICES), model.program, model.observable)
    for recorded in (run, wrong):
        found = conform(subject, simulated.Recorded(tuple(recorded)), widest=60)
        assert found.verdict == "undetermined"
        assert found.reason == "more than 60 states of the model are possible"
        assert found.deviation is None


ROOM = """
reactiveclass Sender(2) {
  knownrebecs { Receiver receiver; }
  Sender() { self.go() after(1); }
  msgsrv go() { if (?(true, false)) { receiver.more(); } }
}
reactiveclass Receiver(1) {
  statevars { int n; }
  Receiver() { n = 0; self.tick() after(1); }
  msgsrv tick() { n = 1; }
  msgsrv more() { n = 2; }
}
main { Sender s(r):(); Receiver r():(); }
"""


def test_an_order_in_which_a_bag_has_room_is_found() -> None:
    """In the order that stands for all, one choice overflows and the other one fits so far."""
    model = simulated.given(ROOM)
    runs = (simulated.simulate(model, seed) for seed in range(50))
    run = next(run for run in runs if any(step.server == "more" for step in run))
    _, found = search(model, run)
    assert found is not None
    assert (found.verdict, found.compared) == ("fits", len(run))


def test_orders_that_commute_are_not_all_tried() -> None:
    """With priorities, senders and deadlines, too: of 300 steps few moments have several orders."""
    model = simulated.given(WAREHOUSE.read_text(encoding="utf-8"))
    run = simulated.simulate(model, 1, 300)
    graph = StateGraph(model.program, model.observable)
    stream = Stream(iter(run), len(model.program.rebecs), _ignored)
    begun = start(graph, stream, "constructors")
    assert Search(graph, stream).run(begun.configs).verdict == "fits"
    assert len(graph._nodes) < 1000
