"""Nodes with the run-time part of a package that they share, on a real roscore."""

from __future__ import annotations

import json

import pytest

from rebsync.config import Config
from rebsync.forward.runtime_package import NAME, runtime_packages
from tests.forward.compiling import generated, written
from tests.ros1 import test_examples as behaviour
from tests.ros1.conftest import Build
from tests.ros1.run import Clock, run
from tests.ros1.test_examples import (
    Example,
    test_each_rebec_serves_what_the_model_says,
    test_nothing_is_reported,
    test_the_run_is_one_of_the_model,
)

__all__ = [
    "test_each_rebec_serves_what_the_model_says",
    "test_nothing_is_reported",
    "test_the_run_is_one_of_the_model",
]


@pytest.fixture(scope="module")
def example(
    dialect: str, build_workspace: Build, tmp_path_factory: pytest.TempPathFactory
) -> Example:
    folder, name = tmp_path_factory.mktemp("shared"), "warehouse"
    config = Config(target=dialect, shared_runtime=True)
    text = (behaviour.EXAMPLES / name / f"{name}.rebeca").read_text(encoding="utf-8")
    package = written(generated(text, name, config), folder, name, config)
    for path, content in runtime_packages(dialect).items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(content)
    workspace = build_workspace(f"shared_{dialect}", [package, folder / NAME])
    expected = json.loads((behaviour.EXPECTED / f"{name}.json").read_text())
    clock = Clock(until=expected["until"] + 0.5, quiet=behaviour.QUIET)
    recording = run(workspace, package / "launch" / f"{name}.launch", folder, clock)
    return Example(name, expected, recording)
