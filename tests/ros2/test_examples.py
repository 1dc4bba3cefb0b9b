"""Generated ROS 2 nodes on the stub of rclcpp: what they do is what their models mean.

The behaviour asked for is that of the same examples on ROS 1, test by test.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from rebsync.config import parse_config
from rebsync.source import Source
from tests.forward.compiling import generated, written
from tests.ros1.test_examples import (
    NAMES,
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
from tests.ros2.building import build_driver, make_messages
from tests.ros2.running import run

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

_ROOT = Path(__file__).parents[2]
_EXPECTED = _ROOT / "tests" / "ros1" / "expected"


def package_of(name: str, directory: Path) -> Path:
    """The ROS 2 package of an example."""
    model = _ROOT / "examples" / name / f"{name}.rebeca"
    settings = model.with_name("rebsync.toml")
    config = parse_config(Source(settings.name, settings.read_text(encoding="utf-8")))
    config = replace(config, target="ros2-cpp")
    text = model.read_text(encoding="utf-8")
    return written(generated(text, name, config), directory, name, config)


@pytest.fixture(scope="module", params=NAMES)
def example(
    request: pytest.FixtureRequest, headers: Path, tmp_path_factory: pytest.TempPathFactory
) -> Example:
    name = str(request.param)
    directory = tmp_path_factory.mktemp(name)
    package = package_of(name, directory)
    make_messages([package], headers)
    driver = build_driver(package, headers, directory / "build")
    expected = json.loads((_EXPECTED / f"{name}.json").read_text())
    return Example(name, expected, run(package, driver, directory, expected["until"] + 0.5))


def test_the_first_move_is_kept_however_late_the_drive_starts(
    headers: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = package_of("experiment1_unsafe", tmp_path)
    make_messages([package], headers)
    driver = build_driver(package, headers, tmp_path / "build")
    expected = json.loads((_EXPECTED / "experiment1_unsafe.json").read_text())
    monkeypatch.setenv("REVERSED_THREADS", "1")
    recording = run(package, driver, tmp_path, 10.5)
    test_velocities_take_every_robot_to_its_cells(Example("late", expected, recording))
