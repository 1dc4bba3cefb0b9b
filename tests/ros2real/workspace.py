"""Builds packages with the ROS 2 that the caller's shell has sourced, each once per content."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.ros1.workspace import build_once

_NEEDED = (
    *("rclcpp", "rclcpp_components", "rclpy", "rosidl_default_generators", "rosidl_generator_py"),
    *("std_msgs", "geometry_msgs", "launch_ros", "ros2launch"),
)
# Cyclone DDS on the loopback interface alone, with room for many nodes.
_LOOPBACK = (
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo'/></Interfaces></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>120</MaxAutoParticipantIndex></Discovery></Domain></CycloneDDS>"
)


class BuildError(Exception):
    """colcon could not build the packages, or warned; the text is its output."""


@dataclass(frozen=True, slots=True)
class Workspace:
    """Installed packages."""

    root: Path

    def environment(self, directory: Path) -> dict[str, str]:
        """The variables that `source install/setup.bash` sets, for a run of its own."""
        setup = self.root / "install" / "setup.bash"
        printed = subprocess.run(
            ["bash", "-c", '. "$0" && env -0', str(setup)],
            env={**sourced(), "CYCLONEDDS_URI": os.environ.get("CYCLONEDDS_URI", _LOOPBACK)},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        variables = dict(line.split("=", 1) for line in printed.split("\0") if line)
        own = {
            "ROS_DOMAIN_ID": str(1 + os.getpid() % 100),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ROS_LOG_DIR": str(directory / "log"),
            "PYTHONUNBUFFERED": "1",
        }
        return {**variables, **own}


def missing_ros2() -> str | None:
    """Why packages cannot be built and run here, or None."""
    for package in _NEEDED:
        if not has_package(package):
            return f"no ROS 2 is sourced: AMENT_PREFIX_PATH has no {package}"
    for tool in ("colcon", "ros2"):
        if shutil.which(tool) is None:
            return f"no {tool}"
    return None


def has_package(name: str) -> bool:
    """Whether the ROS 2 that is sourced has a package."""
    prefixes = [p for p in os.environ.get("AMENT_PREFIX_PATH", "").split(":") if p]
    return any(Path(prefix, "share", name).is_dir() for prefix in prefixes)


def sourced() -> dict[str, str]:
    """The caller's environment without the Python that runs the tests, which has no rclpy."""
    hidden = {str(Path(sys.executable).parent), str(Path(sys.prefix) / "bin")}
    kept = [p for p in os.environ.get("PATH", "").split(":") if p not in hidden]
    variables: Mapping[str, str] = {**os.environ, "PATH": ":".join(kept)}
    dropped = ("VIRTUAL_ENV", "PYTHONDONTWRITEBYTECODE", "PYTHONWARNINGS")
    return {name: value for name, value in variables.items() if name not in dropped}


def build(
    folder: Path, root: Path, below: Workspace | None = None, options: Sequence[str] = ()
) -> Workspace:
    """Build the package in a folder, or all those below it, without a warning of the compiler.

    They may use the packages of the workspace `below`. CMake gets the options.
    """
    environment = sourced() if below is None else below.environment(root)
    build_once([folder], root, lambda made: _make(made, environment, options))
    return Workspace(root)


def _make(root: Path, environment: Mapping[str, str], options: Sequence[str]) -> None:
    command = [
        *("colcon", "--log-base", str(root / "log"), "build", "--merge-install"),
        *("--base-paths", str(root / "src"), "--build-base", str(root / "build")),
        *("--install-base", str(root / "install"), "--parallel-workers", "2"),
        *("--cmake-args", "-DBUILD_TESTING=OFF", "-DCMAKE_CXX_FLAGS=-Werror", *options),
    ]
    done = subprocess.run(
        command,
        env={**environment, "MAKEFLAGS": "-j2"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    if done.returncode != 0:
        raise BuildError(done.stdout)
