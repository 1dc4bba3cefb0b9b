"""Generated sources compile without a warning: hard cases by hand, and drawn models."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import CASES, case_config, generated, written
from tests.forward.test_compiles import _drawn
from tests.ros1.test_hard_cases import NAMES as HARD
from tests.ros2.building import complaints, make_messages

_OFFERING = ("actions", "services")
_DRAWN = 4
_ODOMETRY = Path(__file__).parents[1] / "ros1" / "models" / "odometry.rebeca"


def test_cases(headers: Path, tmp_path: Path) -> None:
    # ROS 1 compiles all of them; test_hard_cases.py compiles and runs its own.
    cases = sorted(c for c in CASES.glob("*.rebeca") if c.stem not in _OFFERING)
    others = [case for case in cases[::2] if case.stem not in HARD]
    assert _complaints_of(others, headers, tmp_path) == []


@pytest.mark.parametrize("name", _OFFERING)
def test_services_and_actions(name: str, headers: Path, tmp_path: Path) -> None:
    assert _complaints_of([CASES / f"{name}.rebeca"], headers, tmp_path) == []


def _complaints_of(cases: list[Path], headers: Path, directory: Path) -> list[str]:
    packages = []
    for case in cases:
        config = replace(case_config(case), target="ros2-cpp")
        files = generated(case.read_text(encoding="utf-8"), case.stem, config)
        packages.append(written(files, directory, case.stem, config))
    return _complaints(packages, headers)


def test_drawn_models(headers: Path, tmp_path: Path) -> None:
    config = Config(target="ros2-cpp")
    packages = [
        written(generated(text, f"drawn{i}", config), tmp_path, f"drawn{i}", config)
        for i, text in enumerate(_drawn(_DRAWN))
    ]
    assert _complaints(packages, headers) == []


def test_odometry(headers: Path, tmp_path: Path) -> None:
    config = Config(target="ros2-cpp", odometry="~odom")
    text = _ODOMETRY.read_text(encoding="utf-8")
    package = written(generated(text, "odometry", config), tmp_path, "odometry", config)
    assert "nav_msgs" in (package / "include" / "odometry" / "drive.hpp").read_text()
    assert _complaints([package], headers) == []


def _complaints(packages: list[Path], headers: Path) -> list[str]:
    make_messages(packages, headers)
    return [text for package in packages for text in complaints(package, headers)]
