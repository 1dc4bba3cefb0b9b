"""The examples on a real ROS 2: what their nodes do is what their models mean."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.ros1 import test_examples as behaviour
from tests.ros1.run import Clock
from tests.ros1.test_examples import (
    Example,
    test_each_rebec_serves_what_the_model_says,
    test_invariants_hold_in_every_state,
    test_nothing_is_lost_at_the_start,
    test_nothing_is_reported,
    test_robots_keep_apart,
    test_the_run_ends_in_the_state_of_the_model,
    test_the_run_gets_somewhere,
    test_the_run_is_one_of_the_model,
    test_the_unsafe_robots_collide,
    test_velocities_take_every_robot_to_its_cells,
)
from tests.ros2real.conftest import DIALECTS, Play

__all__ = [
    "test_each_rebec_serves_what_the_model_says",
    "test_invariants_hold_in_every_state",
    "test_nothing_is_lost_at_the_start",
    "test_nothing_is_reported",
    "test_robots_keep_apart",
    "test_the_run_ends_in_the_state_of_the_model",
    "test_the_run_gets_somewhere",
    "test_the_run_is_one_of_the_model",
    "test_the_unsafe_robots_collide",
    "test_velocities_take_every_robot_to_its_cells",
]

_STEP = 0.02  # s, of the clock at the most
_OWN = Path(__file__).parent / "expected"
# hello has no sends between rebecs: nothing that the ROS 1 tests would learn from it.
_EXPECTED = {f.stem: f for d in (behaviour.EXPECTED, _OWN) for f in sorted(d.glob("*.json"))}


@pytest.fixture(scope="module", params=[f"{n}-{d}" for n in sorted(_EXPECTED) for d in DIALECTS])
def example(
    request: pytest.FixtureRequest, play_real: Play, tmp_path_factory: pytest.TempPathFactory
) -> Example:
    name, _, dialect = str(request.param).partition("-")
    expected = json.loads(_EXPECTED[name].read_text())
    folder = tmp_path_factory.mktemp("packages")
    package = behaviour.example_package(behaviour.EXAMPLES / name, dialect, folder)
    rate = expected.get("rate", behaviour.SLOW)
    # A node may hear of a step of the clock after a message that was sent at it: where robots turn
    # fast, on a slow clock, steps are small.
    step = min(_STEP, rate / 100)
    clock = Clock(until=expected["until"] + 0.5, quiet=behaviour.QUIET, rate=rate, step=step)
    return Example(name, expected, play_real(package, dialect, clock))
