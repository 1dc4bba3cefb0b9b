"""The examples as nodes of rclpy, in one process: what they do is what their models mean."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.ros1 import test_examples as behaviour
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
from tests.ros2py.playing import play

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


@pytest.fixture(scope="module", params=behaviour.NAMES)
def example(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Example:
    name = str(request.param)
    expected = json.loads((behaviour.EXPECTED / f"{name}.json").read_text())
    folder = tmp_path_factory.mktemp("packages")
    package: Path = behaviour.example_package(behaviour.EXAMPLES / name, "ros2-py", folder)
    return Example(name, expected, play(package, expected["until"] + 0.5))
