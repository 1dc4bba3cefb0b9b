"""The core of generated monitors accepts what the checker can do, and nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from random import Random

import pytest
from hypothesis import assume, event, given, settings
from hypothesis import strategies as st

from tests.checker.draw_outlines import Features
from tests.checker.draw_systems import CLOCKED, REAL, TIMED, UNTIMED, WITHOUT_DELAY, systems
from tests.forward.monitoring import (
    Monitored,
    Seen,
    TooLarge,
    is_run,
    monitored,
    mutated,
    shuffled,
    simulated,
)

_STEPS = 25
FAMILIES: dict[str, Features] = {
    "timed": TIMED,
    "without delay": WITHOUT_DELAY,
    "real numbers": REAL,
    "clock": CLOCKED,
    "untimed": UNTIMED,
}


@dataclass(frozen=True)
class _Answer:
    deviates: bool
    doubts: bool
    waiting: int


def _answer(m: Monitored, seen: Sequence[Seen]) -> _Answer:
    run = m.core.Run(m.model)
    for each in seen:
        run.receive(m.core.Observation(*each))
        run.compare()
    return _Answer(run.deviation is not None, bool(run.doubt), run.waiting)


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data(), seed=st.integers(0, 2**20))
def test_true_runs_are_accepted(family: str, data: st.DataObject, seed: int) -> None:
    m = monitored(data.draw(systems(FAMILIES[family])).model)
    seen = simulated(m, seed, _STEPS)
    answer = _answer(m, shuffled(seen, seed))
    assert not answer.deviates, seen
    event(f"doubts {answer.doubts}, all compared {not answer.waiting}")


@pytest.mark.parametrize("family", FAMILIES)
@given(data=st.data(), seed=st.integers(0, 2**20))
def test_mutated_runs_are_judged_as_the_checker_judges_them(
    family: str, data: st.DataObject, seed: int
) -> None:
    m = monitored(data.draw(systems(FAMILIES[family])).model)
    seen = mutated(simulated(m, seed, _STEPS), Random(seed))
    assume(seen)
    answer = _answer(m, shuffled(seen, seed))
    try:
        possible = is_run(m, seen)
    except TooLarge:
        assume(False)
    if answer.deviates:
        assert not possible, seen
    elif not answer.doubts and not answer.waiting:
        assert possible, seen
    event(f"a run {possible}, {answer}")
