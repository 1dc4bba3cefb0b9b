"""What is measured of runs with drawn jitter is what was put in, and calibrated models allow it."""

from __future__ import annotations

from random import Random

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from rebsync.calibration.measure import measure
from rebsync.conform.matching import conform
from rebsync.conform.recording import Served
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse
from tests.calibration.jittered import (
    EPSILON,
    EXAMPLES,
    Extra,
    Measurable,
    Run,
    calibrated,
    measurable,
)

# A smaller seed is no simpler run.
QUICK = settings(
    max_examples=6, deadline=None, phases=[Phase.explicit, Phase.reuse, Phase.generate]
)
NAMES = ("experiment1", "experiment2", "running_example", "hello", "warehouse")


def example(name: str) -> Measurable:
    """The model of an example."""
    return measurable((EXAMPLES / name / f"{name}.rebeca").read_text(encoding="utf-8"))


def no_extra(body: str, random: Random) -> float:
    return 0.0


def slow(part: str, most: float, share: float = 0.5) -> Extra:
    """Bodies whose names have a part take up to `most` units longer, some times."""

    def extra(body: str, random: Random) -> float:
        return random.random() * most if part in body and random.random() < share else 0.0

    return extra


@pytest.mark.parametrize("name", NAMES)
@given(seed=st.integers(0, 10**6))
@QUICK
def test_runs_in_time_ask_for_no_change(name: str, seed: int) -> None:
    model = example(name)
    recorded = Run(model, no_extra, Random(seed)).make(150)
    found = calibrated(model, recorded)
    assert found.changes == () and not found.is_open
    assert found.text == model.subject.source.text
    for place in found.times.places:
        if place.site.kind == "delay" and (shown := place.statistics) is not None:
            assert min(place.model) - EPSILON - 1e-6 <= shown.least
            assert shown.greatest <= max(place.model) + EPSILON + 1e-6


@pytest.mark.parametrize("name", NAMES)
@given(seed=st.integers(0, 10**6), most=st.floats(0.0, 4.0))
@QUICK
def test_what_was_put_in_is_measured(name: str, seed: int, most: float) -> None:
    model = example(name)
    run = Run(model, slow("", most), Random(seed))
    recorded = run.make(150)
    times = measure(model.subject, model.model, recorded)
    counted = 0
    for place in times.places:
        if place.site.kind != "delay" or place.shared or place.statistics is None:
            continue
        took = run.took[place.site.line]
        shown = place.statistics
        assert shown.count + place.shortened <= len(took)
        assert min(took) - EPSILON - 1e-6 <= shown.least <= shown.median <= shown.most
        assert shown.most <= shown.greatest <= max(took) + EPSILON + 1e-6
        counted += shown.count
        # All but what is still going on at the end of the run was measured.
        assert shown.count + place.shortened >= len(took) - len(run.free)
        if shown.count == len(took):
            assert shown.greatest >= max(took) - EPSILON - 1e-6
            assert shown.least <= min(took) + EPSILON + 1e-6
    assert counted > 0


@pytest.mark.parametrize("name", NAMES)
@given(seed=st.integers(0, 10**6), most=st.floats(0.5, 4.0))
@QUICK
def test_a_calibrated_model_is_one_that_allows_the_run(name: str, seed: int, most: float) -> None:
    model = example(name)
    run = Run(model, slow("", most), Random(seed))
    recorded = run.make(120)
    found = calibrated(model, recorded)
    parsed = parse_model(Source("model.rebeca", found.text))
    assert parsed.ok, parsed.diagnostics
    analysis = analyse(parsed.model)
    before = {d.code for d in analyse(model.model).diagnostics}
    assert {d.code for d in analysis.diagnostics} <= before
    assert without_times(found.text) == without_times(model.subject.source.text)
    after = measurable(found.text)
    assert conform(after.subject, recorded).verdict == "conforms"
    again = calibrated(after, recorded)
    assert again.text == found.text and again.changes == ()


def without_times(text: str) -> list[str]:
    """The lines of a text that have no time: comments and layout among them."""
    return [line for line in text.splitlines() if "delay" not in line and "after" not in line]


MODEL = """\
env int e = 2;

@Robot
reactiveclass R(4) {
  knownrebecs { R other; }
  statevars { int n; }
  R() { n = 0; self.go(); }
  // The work.
  msgsrv go() {
    delay(e);  /* two */
    n = n + 1;
    other.hear(n);
    self.go() after(1);
  }
  msgsrv hear(int k) { }
}
main { R a(b):(); R b(a):(); }
"""


def test_a_slow_body_gets_a_choice_and_those_that_wait_for_it_do_not() -> None:
    model = measurable(MODEL)
    recorded = Run(model, lambda body, random: 1.4 if body == "R.go" else 0, Random(1)).make(90)
    found = calibrated(model, recorded)
    (change,) = found.changes
    assert (change.measured.site.body, change.measured.site.line) == ("R.go", 10)
    assert change.text == "e + ?(0, 1, 2)"
    assert found.text == MODEL.replace("delay(e);", "delay(e + ?(0, 1, 2));")
    assert not found.is_open
    assert change.measured.statistics is not None
    assert change.measured.statistics.median == pytest.approx(3.4, abs=2 * EPSILON)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("2", "?(2, 3, 4)"),
        ("(2)", "?(2, 3, 4)"),
        ("?(1, 2)", "?(1, 2, 3, 4)"),
        ("?(2, 3, 4)", "?(2, 3, 4)"),
        ("e", "e + ?(0, 1, 2)"),
        ("e * 1", "e * 1 + ?(0, 1, 2)"),
        ("n > 0 ? 2 : 2", "(n > 0 ? 2 : 2) + ?(0, 1, 2)"),
        ("e + ?(0, 1)", "e + ?(0, 1, 2)"),
        ("e + ?(0, 1, 2, 5)", "e + ?(0, 1, 2, 5)"),
    ],
)
def test_times_are_written_in_the_words_of_the_model(before: str, after: str) -> None:
    """The recording is of the model with `e`; those with other words allow it as well."""
    recorded = Run(measurable(MODEL), lambda body, random: 1.4, Random(1)).make(90)
    text = MODEL.replace("delay(e);", f"delay({before});")
    found = calibrated(measurable(text), recorded)
    assert found.text == MODEL.replace("delay(e);", f"delay({after});")


def test_lateness_within_the_slack_is_no_change_but_what_adds_up_is() -> None:
    def slow_by(extra: float, slack: float) -> int:
        model = measurable(MODEL.replace("go() after(1)", "go()"), slack=slack)
        recorded = Run(model, lambda body, random: extra, Random(1)).make(60)
        return len(calibrated(model, recorded).changes)

    assert slow_by(0.0, 0.5) == 0
    assert slow_by(0.2, 50.0) == 0
    assert slow_by(0.2, 0.5) == 1  # each body is in time, but they are later and later


def test_a_body_without_delay_that_takes_time_is_told() -> None:
    model = measurable(MODEL)
    recorded = Run(model, no_extra, Random(1)).make(90)
    late = [
        e._replace(stamp=e.stamp + 3) if isinstance(e, Served) and e.server == "hear" else e
        for e in recorded.events()
    ]
    found = calibrated(model, type(recorded)(tuple(late)))
    (slow_body,) = found.times.slow
    assert (slow_body.body, slow_body.line) == ("R.hear", 15)
    assert found.is_open


def test_a_method_cannot_choose() -> None:
    text = MODEL.replace("    delay(e);  /* two */\n", "    work();\n")
    text = text.replace("  msgsrv hear", "  void work() { delay(e); }\n  msgsrv hear")
    model = measurable(text)
    found = calibrated(model, Run(model, lambda body, random: 1.4, Random(1)).make(90))
    (stuck,) = found.impossible
    assert "server" in stuck.reason and stuck.measured.site.body == "R.work"
    assert found.text == text and found.is_open


def test_time_units_and_slack_are_in_seconds() -> None:
    model = measurable(MODEL, time_unit=0.1, slack=0.05)
    recorded = Run(model, lambda body, random: 1.4, Random(1)).make(60)
    found = calibrated(model, recorded)
    assert [c.text for c in found.changes] == ["e + ?(0, 1, 2)"]
    assert found.times.slack == pytest.approx(0.5)


def test_periods_afters_and_deadlines_are_measured() -> None:
    text = MODEL.replace("other.hear(n);", "other.hear(n) after(1) deadline(9);")
    model = measurable(text)
    times = measure(model.subject, model.model, Run(model, no_extra, Random(1)).make(120))
    found = {(p.site.kind, p.site.line): p for p in times.places}
    assert {key: p.model for key, p in found.items()} == {
        ("delay", 10): (2,), ("after", 12): (1,), ("deadline", 12): (9,),
        ("after", 13): (), ("period", 13): (3,),
    }  # fmt: skip
    period = found["period", 13].statistics
    assert period is not None and period.median == pytest.approx(3, abs=EPSILON * 2)
    after = found["after", 12].statistics
    assert after is not None and 1 <= after.greatest < 3.1
