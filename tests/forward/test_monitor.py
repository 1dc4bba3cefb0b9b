"""The core of generated monitors accepts what the checker can do, and nothing else."""

from __future__ import annotations

import shutil
import signal
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import Phase, assume, event, given, settings
from hypothesis import strategies as st

from tests.checker.draw_outlines import Features
from tests.checker.draw_systems import CLOCKED, REAL, TIMED, UNTIMED, WITHOUT_DELAY, systems
from tests.forward.monitoring import (
    Monitored,
    Seen,
    TooLarge,
    as_text,
    built_driver,
    is_run,
    monitored,
    mutated,
    shuffled,
    simulated,
    without_beginning,
)

# To shrink a model takes longer than a test may, and the time limit then hides what was wrong.
_UNSHRUNK = set(Phase) - {Phase.shrink}
_STEPS = 8
_SECONDS = 2
_FEW, _USUAL = 16, 1024  # hypotheses: to follow more takes long
FAMILIES: dict[str, Features] = {
    "timed": TIMED,
    "without delay": WITHOUT_DELAY,
    "real numbers": REAL,
    "clock": CLOCKED,
    "untimed": UNTIMED,
}


@dataclass(frozen=True)
class _Answer:
    """What is said of a run; `missed` are the rebecs that were not heard from their beginning."""

    deviates: bool
    doubts: bool
    waiting: int
    missed: tuple[int, ...] = ()


class _TooLong(BaseException):
    """A comparison takes more time of a processor than a test has."""


def _given_up(_: int, __: object) -> None:
    raise _TooLong


def _begun(m: Monitored, hypotheses: int) -> Any:  # noqa: ANN401
    """A comparison that gives up at more than so many hypotheses."""
    vars(m.core)["_HYPOTHESES"] = hypotheses
    return m.core.Run(m.model)


def _answer(m: Monitored, seen: Sequence[Seen]) -> _Answer:
    run = _begun(m, _FEW)
    before = signal.signal(signal.SIGVTALRM, _given_up)
    signal.setitimer(signal.ITIMER_VIRTUAL, _SECONDS)
    try:
        for each in seen:
            run.receive(m.core.Observation(*each))
            run.compare()
    except _TooLong:
        return _Answer(False, True, 1)  # nothing is concluded
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
    missed = tuple(i for i, r in enumerate(m.model.rebecs) if r.name in run.missed)
    return _Answer(run.deviation is not None, bool(run.doubt), run.waiting, missed)


@pytest.mark.parametrize("family", FAMILIES)
@settings(max_examples=10, phases=_UNSHRUNK)
@given(data=st.data(), seed=st.integers(0, 2**20))
def test_true_runs_are_accepted(family: str, data: st.DataObject, seed: int) -> None:
    m = monitored(data.draw(systems(FAMILIES[family])).model)
    seen = simulated(m, seed, _STEPS)
    answer = _answer(m, shuffled(seen, seed))
    assert not answer.deviates, seen
    event(f"doubts {answer.doubts}, all compared {not answer.waiting}")


@pytest.mark.parametrize("family", FAMILIES)
@settings(max_examples=4, phases=_UNSHRUNK)
@given(data=st.data(), seed=st.integers(0, 2**20))
def test_a_beginning_that_was_not_heard_is_filled_in(
    family: str, data: st.DataObject, seed: int
) -> None:
    m = monitored(data.draw(systems(FAMILIES[family])).model)
    seen = without_beginning(m, simulated(m, seed, _STEPS), Random(seed))
    answer = _answer(m, shuffled(seen, seed))
    assert not answer.deviates, seen
    event(f"doubts {answer.doubts}, all compared {not answer.waiting}")


@pytest.mark.parametrize("family", FAMILIES)
@settings(max_examples=10, phases=_UNSHRUNK)
@given(data=st.data(), seed=st.integers(0, 2**20))
def test_mutated_runs_are_judged_as_the_checker_judges_them(
    family: str, data: st.DataObject, seed: int
) -> None:
    m = monitored(data.draw(systems(FAMILIES[family])).model)
    seen = mutated(simulated(m, seed, _STEPS), Random(seed))
    assume(seen)
    answer = _answer(m, shuffled(seen, seed))
    try:
        possible = is_run(m, seen, answer.missed)
    except TooLarge:
        assume(False)
    if answer.deviates:
        assert not possible, seen
    elif not answer.doubts and not answer.waiting:
        assert possible, seen
    event(f"a run {possible}, {answer}")


LATE = """
reactiveclass C(2) {
  statevars { boolean v; }
  C() { self.m(); }
  msgsrv m() { v = true; }
}
main { C r():(); C s():(); }
"""


def test_a_constructor_that_was_not_heard_is_filled_in_and_named() -> None:
    """It may have been published before the monitor came: not so a state in the middle."""
    m = monitored(LATE)
    built, served = ("constructor", "", 0, 0, 0, (0,)), ("m", "", 0, 0, 0, (1,))
    seen: list[Seen] = [(0, *built), (0, *served), (1, *served)]
    assert _answer(m, seen) == _Answer(False, False, 0, missed=(1,))
    assert is_run(m, seen, [1])
    assert not is_run(m, seen)
    watch = m.core.Watch(m.model, False)
    for each in seen:
        watch.receive(m.core.Observation(*each), 0.0)
    status = watch.status(0.0)
    assert status.facts["not heard from the beginning"] == "s"
    assert status.message.endswith("; not heard from the beginning: s")
    seen.append((1, *served))  # of which there is one only
    assert _answer(m, seen).deviates
    assert not is_run(m, seen, [1])


# --- the core in C++ ----------------------------------------------------------------------------


@pytest.fixture(scope="session")
def driver(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The core in C++ with a program that feeds it."""
    if shutil.which("g++") is None:
        pytest.skip("no g++")
    return built_driver(tmp_path_factory.mktemp("monitor"))


@pytest.mark.parametrize("family", FAMILIES)
@settings(max_examples=3, phases=_UNSHRUNK)
@given(data=st.data(), seed=st.integers(0, 2**20))
def test_both_languages_say_the_same(
    driver: Path, family: str, data: st.DataObject, seed: int
) -> None:
    m = monitored(data.draw(systems(FAMILIES[family])).model)
    true = simulated(m, seed, _STEPS)
    others = [mutated(true, Random(n)) for n in range(8)]
    runs = [shuffled(r, seed) for r in (true, *others)]
    said = subprocess.run(
        [driver], input=f"1\n{as_text(m, runs)}", capture_output=True, text=True, check=True
    )
    assert said.stdout.splitlines() == [_told(m, seen) for seen in runs]


def _told(m: Monitored, seen: Sequence[Seen]) -> str:
    """What the driver prints of a run, by the core in Python."""
    run = _begun(m, _USUAL)
    for each in seen:
        run.receive(m.core.Observation(*each))
        run.compare()
    found = run.deviation
    told = f" deviation {found.rebec}|{found.step}|{found.observed}" if found else ""
    return f"{run.compared} {run.waiting} {run.hypotheses}{told} {run.doubt}"
