"""Drives that hear the robot's odometry, on a base that slips, or that is too slow."""

from __future__ import annotations

import json
import math
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.conftest import Build
from tests.ros1.run import launched, ros_environment
from tests.ros1.workspace import SYSTEM_PYTHON, Workspace

_HERE = Path(__file__).parent
_BASE = _HERE / "nodes" / "base.py"
MODEL = _HERE / "models" / "odometry.rebeca"  # 2 m, a pause, 1 m to the left


class Driving(Protocol):
    """Runs the model with a base, and gives what that says and what the nodes wrote."""

    def __call__(
        self, directory: Path, grip: float, fastest: float, told: float = math.inf
    ) -> tuple[dict[str, Any], str]: ...


@pytest.fixture(scope="module")
def driving(
    dialect: str, build_workspace: Build, tmp_path_factory: pytest.TempPathFactory
) -> Driving:
    config = Config(target=dialect, odometry="~odom")
    files = generated(MODEL.read_text(encoding="utf-8"), "odometry", config)
    package = written(files, tmp_path_factory.mktemp("odometry"), "odometry", config)
    return _Roslaunch(build_workspace(f"odometry_{dialect}", [package]))


def test_a_robot_that_slips_gets_there(driving: Driving, tmp_path: Path) -> None:
    base, output = driving(tmp_path, grip=0.7, fastest=9)
    # Reckoned alone it would be at 1.4 and 0.7, with differences of 0.6 and 0.3 that nobody knows.
    assert base["driven"] == pytest.approx([2, 1], abs=0.25)
    assert base["differences"] == pytest.approx([0, 0], abs=0.45)
    assert base["last"] == 0
    assert "planned 2.0" in output and "no odometry" not in output


def test_time_ends_the_move_of_a_robot_that_is_slow(driving: Driving, tmp_path: Path) -> None:
    base, output = driving(tmp_path, grip=1, fastest=0.5)
    assert base["differences"][0] == pytest.approx(1, abs=0.15)  # 2 s at 0.5 m/s, of 2 m
    assert base["last"] == 0
    assert "m from the goal" in output


def test_odometry_that_is_missing_is_reported(driving: Driving, tmp_path: Path) -> None:
    base, output = driving(tmp_path, grip=1, fastest=9, told=0)
    assert "drive: robot.cmd_vel (no odometry on /robot/odom)" in output
    assert base["driven"] == pytest.approx([2, 1], abs=0.25)
    assert base["last"] == 0


def test_a_robot_whose_odometry_is_lost_in_mid_move_goes_no_farther(
    driving: Driving, tmp_path: Path
) -> None:
    base, output = driving(tmp_path, grip=1, fastest=9, told=0.5)
    assert base["driven"] == pytest.approx([2, 1], abs=0.25)
    assert base["last"] == 0
    assert output.count("no odometry on /robot/odom") == 1  # in the second move


@dataclass(frozen=True)
class _Roslaunch:
    workspace: Workspace

    def __call__(
        self, directory: Path, grip: float, fastest: float, told: float = math.inf
    ) -> tuple[dict[str, Any], str]:
        port, environment = ros_environment(self.workspace, directory)
        launch = self.workspace.root / "src" / "odometry" / "launch" / "odometry.launch"
        command = ["roslaunch", "--skip-log-check", "-p", str(port), str(launch)]
        base = [SYSTEM_PYTHON, str(_BASE), "robot", *map(str, (grip, fastest, told, 14))]
        return driven(command, base, directory, environment)


def driven(
    command: Sequence[str], base: Sequence[str], directory: Path, environment: Mapping[str, str]
) -> tuple[dict[str, Any], str]:
    """What a base says after the model's moves, and what the nodes wrote."""
    with launched(command, directory, environment):
        done = subprocess.run(
            base, env=environment, stdout=subprocess.PIPE, text=True, timeout=90, check=True
        )
    return json.loads(done.stdout.splitlines()[-1]), (directory / "output").read_text()
