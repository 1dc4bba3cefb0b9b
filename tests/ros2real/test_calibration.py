"""A real rclcpp does what the stub of it does, so that what runs on the stub runs here."""

from __future__ import annotations

import subprocess
from pathlib import Path

from tests.ros2.test_calibration import PACKAGE, expected, ordered
from tests.ros2real.conftest import Builder

_PARAMETERS = ("whole:=5", "real:=2.5", "truth:=true", "name:='x y'", "grid:=[4, 5]")
_QUALITIES = (
    "qos_overrides./told/quality.subscription.reliability:=reliable",
    "qos_overrides./told/deep.publisher.history:=keep_all",
    "qos_overrides./told/deep.publisher.depth:=20",
    "qos_overrides./told/shallow.publisher.depth:=2",
)
_WRONG = ("wrong:=many", "rounded:=1")


def test_rclcpp_tells_what_the_stub_tells(build_real: Builder, tmp_path: Path) -> None:
    workspace = build_real(PACKAGE, "calibration")
    options = [word for value in (*_PARAMETERS, *_QUALITIES, *_WRONG) for word in ("-p", value)]
    names = ["-r", "__node:=told", "-r", "~/moved:=elsewhere"]
    program = workspace.root / "install/lib/calibration/calibration_node"
    done = subprocess.run(
        [str(program), "--ros-args", *names, *options],
        env=workspace.environment(tmp_path),
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert ordered(done.stdout) == expected()
