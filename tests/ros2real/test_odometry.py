"""Drives that hear the robot's odometry, on a real ROS 2, with a base that slips or is too slow."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1 import test_odometry as moves
from tests.ros1.test_odometry import (
    Driving,
    test_a_robot_that_slips_gets_there,
    test_a_robot_whose_odometry_is_lost_in_mid_move_goes_no_farther,
    test_odometry_that_is_missing_is_reported,
    test_time_ends_the_move_of_a_robot_that_is_slow,
)
from tests.ros1.workspace import SYSTEM_PYTHON
from tests.ros2real.conftest import DIALECTS, Builder
from tests.ros2real.workspace import Workspace

__all__ = [
    "test_a_robot_that_slips_gets_there",
    "test_a_robot_whose_odometry_is_lost_in_mid_move_goes_no_farther",
    "test_odometry_that_is_missing_is_reported",
    "test_time_ends_the_move_of_a_robot_that_is_slow",
]

_BASE = Path(__file__).parent / "nodes" / "base.py"
_WHEELS = Path(moves.__file__).parent / "nodes"
_SECONDS = 18


@dataclass(frozen=True)
class _Ros2Launch:
    workspace: Workspace

    def __call__(
        self, directory: Path, grip: float, fastest: float, told: float = math.inf
    ) -> tuple[dict[str, Any], str]:
        found = self.workspace.environment(directory)
        environment = {**found, "PYTHONPATH": f"{found['PYTHONPATH']}:{_WHEELS}"}
        launch = self.workspace.root / "install/share/odometry/launch/odometry.launch.py"
        options = map(str, (grip, fastest, told, _SECONDS))
        base = [SYSTEM_PYTHON, str(_BASE), "robot", *options]
        return moves.driven(["ros2", "launch", str(launch)], base, directory, environment)


@pytest.fixture(scope="module", params=DIALECTS)
def driving(
    request: pytest.FixtureRequest, build_real: Builder, tmp_path_factory: pytest.TempPathFactory
) -> Driving:
    dialect = str(request.param)
    config = Config(target=dialect, odometry="~odom")
    files = generated(moves.MODEL.read_text(encoding="utf-8"), "odometry", config)
    package = written(files, tmp_path_factory.mktemp("odometry"), "odometry", config)
    return _Ros2Launch(build_real(package, f"odometry_{dialect}"))
