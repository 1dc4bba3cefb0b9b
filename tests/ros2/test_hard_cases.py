"""Hard cases of the language as nodes of rclcpp, run on the stub."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.forward.compiling import CASES, case_config, case_files, written
from tests.ros1.fidelity import log_of
from tests.ros1.recording import Recording
from tests.ros1.test_hard_cases import (
    PlayCase,
    RecordProperty,
    assert_is_run,
    test_inheritance,
    test_interfaces,
    test_overloads,
    test_rebecs_as_values,
)
from tests.ros2.building import build_driver, make_messages
from tests.ros2.running import run

__all__ = ["test_inheritance", "test_interfaces", "test_overloads", "test_rebecs_as_values"]


@pytest.fixture
def play_case(headers: Path, tmp_path: Path, record_property: RecordProperty) -> PlayCase:
    """Runs a case by its name."""

    def played(name: str) -> Recording:
        case = CASES / f"{name}.rebeca"
        config = replace(case_config(case), target="ros2-cpp")
        package = written(case_files(case, "ros2-cpp"), tmp_path, name, config)
        make_messages([package], headers)
        driver = build_driver(package, headers, tmp_path / "build")
        recording = run(package, driver, tmp_path, 12)
        assert_is_run(name, "ros2-cpp", log_of(recording, tmp_path), record_property)
        return recording

    return played
