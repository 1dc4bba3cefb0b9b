"""The arguments of generated launch files, as roslaunch takes them."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path
from typing import Any

import pytest
import yaml

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.workspace import SYSTEM_PATH, missing_ros

_REASON = missing_ros()
pytestmark = [
    pytest.mark.ros1,
    pytest.mark.skipif(
        _REASON is not None and os.environ.get("CI") != "true", reason=_REASON or ""
    ),
]
_MODEL = """
env int limit = 3;
reactiveclass A(3) {
  knownrebecs { A other; }
  A(int n) { if (n < limit) { self.begin(); } }
  msgsrv begin() { other.go(); }
  msgsrv go() {}
}
main { A a(b):(1); A b(a):(2); }
"""


@pytest.fixture(params=["ros1-cpp", "ros1-py"])
def package(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    config = Config(target=request.param, time_unit=0.25)
    return written(generated(_MODEL, "pair", config), tmp_path / "src", "pair", config)


def _roslaunch(package: Path, option: str, *arguments: str) -> str:
    done = subprocess.run(
        ["roslaunch", option, str(package / "launch" / "pair.launch"), *arguments],
        env={
            "PATH": SYSTEM_PATH,
            "HOME": str(package.parent),
            "ROS_PACKAGE_PATH": f"{package.parent}:/usr/share",
            "ROS_ROOT": "/usr/share/ros",
            "ROS_MASTER_URI": "http://127.0.0.1:11311",
        },
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def _parameters(package: Path, *arguments: str) -> dict[str, Any]:
    return dict(yaml.safe_load(_roslaunch(package, "--dump-params", *arguments)))


def test_without_arguments_the_parameters_are_those_of_the_package(package: Path) -> None:
    parameters = _parameters(package)
    assert parameters["/limit"] == 3
    assert parameters["/mailbox/time_unit"] == 0.25
    assert "/use_sim_time" not in parameters  # another launch file may have set it


def test_parameters_of_ones_own_replace_those_of_the_package_one_by_one(package: Path) -> None:
    own = package.parent / "own.yaml"
    own.write_text("limit: 7\nmailbox:\n  slack: 9.0\n")
    parameters = _parameters(package, f"params_file:={own}")
    assert (parameters["/limit"], parameters["/mailbox/slack"]) == (7, 9.0)
    assert parameters["/mailbox/time_unit"] == 0.25


def test_the_clock_of_a_simulation(package: Path) -> None:
    assert _parameters(package, "use_sim_time:=true")["/use_sim_time"] is True


def test_a_namespace_is_what_roslaunch_has_a_word_for(package: Path) -> None:
    nodes = _roslaunch(package, "--nodes", "__ns:=hall").split()
    assert sorted(nodes) == ["/hall/a", "/hall/b"]
    parameters = _parameters(package, "__ns:=hall", "use_sim_time:=true")
    assert parameters["/hall/limit"] == 3
    assert parameters["/use_sim_time"] is True
