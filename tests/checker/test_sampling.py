"""Runs by chance: their values are those of the runs, within what a full search finds."""

from __future__ import annotations

from collections import Counter
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync.checker.exploration import Limits
from rebsync.checker.lowering import lower
from rebsync.checker.sampling import Sample, SampleValues, estimate, samples, share
from rebsync.checker.search import Interpreted
from rebsync.checker.simulate import by_chance, run
from rebsync.checker.telling import Teller
from rebsync.checker.views import view_of
from rebsync.model import Member, Name
from rebsync.properties import Measure
from tests.checker.comparing import System
from tests.checker.draw_systems import TIMED, Drawn, systems

WALK = """
reactiveclass Walker(2) {
  statevars { int place; boolean heads; }
  Walker() { self.go(); }
  msgsrv go() {
    heads = ?(true, false);
    place = place + (heads ? 1 : -1);
    assertion(place < 3, "far");
    if (place > -4) { self.go() after(1); }
  }
}
main { Walker w():(); }
"""
PLACE, HEADS = (Measure(name, Member(Name("w"), name)) for name in ("place", "heads"))


def _samples(seed: int, runs: int, steps: int) -> list[Sample]:
    system = System.of(WALK)
    program, _ = lower(system.analysis, measures=(PLACE, HEADS))
    return list(samples(program, "ftts", seed, runs, steps=steps))


def test_a_sample_has_the_values_of_its_run() -> None:
    system = System.of(WALK)
    teller = Teller(view_of(system.program, "ftts"), system.source)
    for number, sample in enumerate(_samples(10, 40, 12)):
        told = list(run(teller, by_chance(10 + number), steps=12))
        states = [s.rebecs[0] for s in told if s.failure is None]
        places = [int(dict(rebec.variables)["place"]) for rebec in states]
        assert sample.values[0] == SampleValues(min(places), max(places), places[-1])
        assert (sample.steps, sample.time) == (told[-1].number, told[-1].until)
        is_over = told[-1].failure is None and not states[-1].bag
        assert sample.end == ("assertion" if told[-1].failure else "ended" if is_over else "cut")


def test_ends_of_all_kinds_are_met() -> None:
    assert Counter(sample.end for sample in _samples(0, 60, 12)).keys() == {
        "assertion",
        "ended",
        "cut",
    }


@settings(max_examples=15)
@given(drawn=systems(TIMED), data=st.data())
def test_samples_stay_within_what_a_full_search_finds(drawn: Drawn, data: st.DataObject) -> None:
    system = System.of(drawn.model)
    measures = tuple(
        Measure(slot.name, Member(Name(rebec.name), slot.name))
        for rebec in system.program.rebecs
        for slot in rebec.state
        if slot.kind in ("int", "byte", "boolean") and not slot.type.dimensions
    )
    program, _ = lower(system.analysis, measures=measures)
    found = Interpreted(program, "tts").run(Limits(states=2000))
    if found.reason is not None:
        return
    for sample in samples(program, "tts", data.draw(st.integers(0, 99)), 5, steps=20):
        for values, extremes in zip(sample.values, found.measured, strict=True):
            if values is not None:
                assert extremes.least <= values.least <= values.last <= values.greatest
                assert values.greatest <= extremes.greatest


@pytest.mark.parametrize(
    ("found", "of", "low", "high"),  # computed from the formula of Wilson (1927)
    [
        (0, 10, 0.0, 0.2775),
        (5, 10, 0.2366, 0.7634),
        (10, 10, 0.7225, 1.0),
        (1, 263, 0.0007, 0.0212),
    ],
)
def test_the_interval_of_a_probability(found: int, of: int, low: float, high: float) -> None:
    assert share(found, of) == pytest.approx((low, high), abs=5e-5)


def test_intervals_contain_the_mean_about_as_often_as_they_say() -> None:
    random = Random(7)
    trials = 400
    for faces in (2, 6):
        met = 0
        for _ in range(trials):
            found = estimate([random.randrange(faces) for _ in range(100)])
            assert found is not None
            met += found.interval[0] <= (faces - 1) / 2 <= found.interval[1]
        assert 0.92 <= met / trials <= 0.98


def test_every_value_is_in_a_bin() -> None:
    found = estimate([-7, *range(100), 300])
    assert found is not None
    assert sum(count for _, _, count in found.counts) == found.count == 102
    assert found.counts[0][0] == -7 and found.counts[-1][1] == 300
    assert found.quartiles == (-7, 24, 49, 74, 300)
    assert estimate([3]) is None
