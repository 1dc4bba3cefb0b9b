"""What drives that hear odometry report, in C++ on the stub and in Python in one process."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.recording import Recording
from tests.ros1.test_odometry import MODEL
from tests.ros2.building import build_driver, make_messages
from tests.ros2.running import run
from tests.ros2py.playing import play

_UNTIL = 8


def _package(dialect: str, folder: Path) -> Path:
    config = Config(target=dialect, odometry="~odom")
    files = generated(MODEL.read_text(encoding="utf-8"), "odometry", config)
    return written(files, folder, "odometry", config)


def _in_cpp(headers: Path, folder: Path) -> Recording:
    package = _package("ros2-cpp", folder)
    make_messages([package], headers)
    return run(package, build_driver(package, headers, folder / "build"), folder, _UNTIL)


@pytest.mark.parametrize("dialect", ["ros2-cpp", "ros2-py"])
def test_odometry_that_is_missing_is_named_by_its_whole_topic(
    dialect: str, headers: Path, tmp_path: Path
) -> None:
    if dialect == "ros2-cpp":
        recording = _in_cpp(headers, tmp_path)
    else:
        recording = play(_package(dialect, tmp_path), _UNTIL)
    facts = {r.facts for r in recording.reports("drive")}
    assert "no odometry on /robot/odom" in facts
