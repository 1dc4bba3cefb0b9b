"""Nodes in C++ and nodes in Python in one system of a real ROS 2, of one model."""

from __future__ import annotations

import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from rebsync.config import Config, parse_config
from rebsync.source import Source
from tests.forward.compiling import generated, written
from tests.ros1 import test_examples as behaviour
from tests.ros1.run import Clock
from tests.ros1.test_examples import (
    Example,
    test_each_rebec_serves_what_the_model_says,
    test_invariants_hold_in_every_state,
    test_nothing_is_lost_at_the_start,
    test_nothing_is_reported,
    test_the_run_ends_in_the_state_of_the_model,
    test_the_run_is_one_of_the_model,
)
from tests.ros2real.conftest import Builder, Play

__all__ = [
    "test_each_rebec_serves_what_the_model_says",
    "test_invariants_hold_in_every_state",
    "test_nothing_is_lost_at_the_start",
    "test_nothing_is_reported",
    "test_the_run_ends_in_the_state_of_the_model",
    "test_the_run_is_one_of_the_model",
]

_NAME, _PYTHON = "experiment2", "experiment2_robots"
_CONTROLLER = "control_node_node"  # in C++; the robots are in Python


@pytest.fixture(scope="module")
def example(
    build_real: Builder, play_real: Play, tmp_path_factory: pytest.TempPathFactory
) -> Example:
    folder = tmp_path_factory.mktemp("mixed")
    below = build_real(_package("ros2-cpp", _NAME, folder), f"{_NAME}_ros2-cpp")
    robots = _robots(_package("ros2-py", _PYTHON, folder))
    workspace = build_real(robots, f"{_NAME}_mixed", below)
    expected = json.loads((behaviour.EXPECTED / f"{_NAME}.json").read_text())
    rate = expected.get("rate", behaviour.SLOW)
    clock = Clock(until=expected["until"] + 0.5, quiet=behaviour.QUIET, rate=rate)
    recording = play_real.launched(workspace, robots / _PYTHON, "ros2-py", clock)
    return Example(_NAME, expected, recording)


def _package(dialect: str, name: str, folder: Path) -> Path:
    """The package of the example in a dialect, under a name of its own."""
    example = behaviour.EXAMPLES / _NAME
    settings = example / "rebsync.toml"
    found = parse_config(Source(settings.name, settings.read_text())) if settings.exists() else None
    config = replace(found or Config(), target=dialect, package=name)
    text = (example / f"{_NAME}.rebeca").read_text(encoding="utf-8")
    return written(generated(text, _NAME, config), folder, _NAME, config)


def _robots(package: Path) -> Path:
    """Have a package in Python use the messages and the controller of the one in C++."""
    shutil.rmtree(package / f"{_PYTHON}_interfaces")
    for path in (p for p in package.rglob("*") if p.is_file()):
        path.write_text(path.read_text().replace(f"{_PYTHON}_interfaces", _NAME))
    launch = package / _PYTHON / "launch" / f"{_PYTHON}.launch.py"
    pattern = rf'package="{_PYTHON}",(\s+executable="{_CONTROLLER}")'
    moved, count = re.subn(pattern, rf'package="{_NAME}",\1', launch.read_text())
    assert count == 1
    launch.write_text(moved)
    return package
