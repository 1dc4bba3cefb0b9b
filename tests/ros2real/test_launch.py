"""The real launch and launch_ros tell nodes what the stand-ins for them say."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from tests.forward.compiling import CASES, case_config, case_files, written
from tests.ros2.launching import Launched, launched
from tests.ros2real.workspace import sourced

_TOLD = Path(__file__).parent / "nodes" / "told.py"


@pytest.mark.parametrize("name", sorted(case.stem for case in CASES.glob("*.rebeca")))
def test_nodes_are_told_what_the_model_says(name: str, tmp_path: Path) -> None:
    case = CASES / f"{name}.rebeca"
    config = replace(case_config(case), target="ros2-cpp")
    package = written(case_files(case, config.target), tmp_path, name, config)
    _assert_told(package, {}, tmp_path)


def test_nodes_are_told_what_the_arguments_say(tmp_path: Path) -> None:
    """A namespace, a simulated clock, parameters of one's own, and how much is logged."""
    case = CASES / "rebecs.rebeca"
    config = replace(case_config(case), target="ros2-cpp")
    package = written(case_files(case, config.target), tmp_path, case.stem, config)
    own = tmp_path / "own.yaml"
    own.write_text("/**:\n  ros__parameters:\n    mailbox:\n      slack: 7.0\n")
    arguments = {
        "namespace": "hall",
        "use_sim_time": "true",
        "params_file": str(own),
        "log_level": "debug",
    }
    nodes = _assert_told(package, arguments, tmp_path)
    assert {n.namespace for n in nodes} == {"hall"}
    assert {n.parameters["mailbox.slack"] for n in nodes} == {7.0}
    assert {n.parameters["use_sim_time"] for n in nodes} == {True}


def _assert_told(package: Path, arguments: Mapping[str, str], tmp_path: Path) -> list[Launched]:
    name, nodes, told = package.name, launched(package, **arguments), tmp_path / "told"
    told.mkdir()
    prefix = _installed(package, {node.executable for node in nodes}, tmp_path / "prefix")
    before = os.environ["AMENT_PREFIX_PATH"]
    own = {"REBSYNC_TOLD": str(told), "ROS_LOG_DIR": str(tmp_path / "log")}
    given = [f"{key}:={value}" for key, value in arguments.items()]
    done = subprocess.run(
        ["ros2", "launch", name, f"{name}.launch.py", *given],
        env={**sourced(), **own, "AMENT_PREFIX_PATH": f"{prefix}:{before}"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stdout
    found = {file.stem: json.loads(file.read_text()) for file in told.iterdir()}
    assert found == {
        node.name: {
            "executable": node.executable,
            "namespace": node.namespace,
            "parameters": dict(node.parameters),
            "remaps": [list(pair) for pair in node.remappings],
            "log_level": dict(zip(node.ros_arguments[::2], node.ros_arguments[1::2], strict=True))[
                "--log-level"
            ],
        }
        for node in nodes
    }, done.stdout
    return nodes


def _installed(package: Path, executables: set[str], prefix: Path) -> Path:
    """The package as installed, with programs that only write down what they are told."""
    index = prefix / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / package.name).touch()
    for folder in ("launch", "config"):
        shutil.copytree(package / folder, prefix / "share" / package.name / folder)
    programs = prefix / "lib" / package.name
    programs.mkdir(parents=True)
    for name in executables:
        shutil.copy(_TOLD, programs / name)
        (programs / name).chmod(0o755)
    return prefix
