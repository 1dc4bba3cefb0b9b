"""Nodes in C++ and nodes in Python in one system, on a real roscore."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from rebsync.config import ClassTarget, Config, parse_config
from rebsync.source import Source
from tests.forward.compiling import generated, written
from tests.ros1 import test_examples as behaviour
from tests.ros1.conftest import Build
from tests.ros1.run import Clock, run
from tests.ros1.test_examples import (
    Example,
    test_each_rebec_serves_what_the_model_says,
    test_invariants_hold_in_every_state,
    test_nothing_is_lost_at_the_start,
    test_nothing_is_reported,
    test_the_run_ends_in_the_state_of_the_model,
    test_the_run_is_one_of_the_model,
)

__all__ = [
    "test_each_rebec_serves_what_the_model_says",
    "test_invariants_hold_in_every_state",
    "test_nothing_is_lost_at_the_start",
    "test_nothing_is_reported",
    "test_the_run_ends_in_the_state_of_the_model",
    "test_the_run_is_one_of_the_model",
]

# A controller in C++ with robots in Python, and the reverse.
_SYSTEMS: Mapping[str, Mapping[str, str]] = {
    "experiment2": {"R1": "ros1-py", "R2": "ros1-py"},
    "warehouse": {"Dispatcher": "ros1-py"},
}


@pytest.fixture(scope="module", params=sorted(_SYSTEMS))
def example(
    request: pytest.FixtureRequest, build_workspace: Build, tmp_path_factory: pytest.TempPathFactory
) -> Example:
    name = str(request.param)
    folder = tmp_path_factory.mktemp(name)
    package = _package(name, folder)
    assert (package / "CMakeLists.txt").read_text().count("catkin_python_setup()") == 1
    workspace = build_workspace(f"mixed_{name}", [package])
    expected = json.loads((behaviour.EXPECTED / f"{name}.json").read_text())
    clock = Clock(until=expected["until"] + 0.5, quiet=behaviour.QUIET)
    recording = run(workspace, package / "launch" / f"{name}.launch", folder, clock)
    return Example(name, expected, recording)


def _package(name: str, folder: Path) -> Path:
    example = behaviour.EXAMPLES / name
    settings = example / "rebsync.toml"
    config = (
        parse_config(Source(settings.name, settings.read_text())) if settings.exists() else Config()
    )
    targets = tuple(ClassTarget(c, t) for c, t in _SYSTEMS[name].items())
    config = replace(config, targets=targets)
    text = (example / f"{name}.rebeca").read_text(encoding="utf-8")
    return written(generated(text, name, config), folder, name, config)
