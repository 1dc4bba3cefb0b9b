"""The real launch and launch_ros tell nodes what the stand-ins for them say."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from tests.forward.compiling import CASES, case_config, case_files, written
from tests.ros2.launching import launched
from tests.ros2real.workspace import sourced

_TOLD = Path(__file__).parent / "nodes" / "told.py"


@pytest.mark.parametrize("name", sorted(case.stem for case in CASES.glob("*.rebeca")))
def test_nodes_are_told_what_the_model_says(name: str, tmp_path: Path) -> None:
    case = CASES / f"{name}.rebeca"
    config = replace(case_config(case), target="ros2-cpp")
    package = written(case_files(case, config.target), tmp_path, name, config)
    nodes, told = launched(package), tmp_path / "told"
    told.mkdir()
    prefix = _installed(package, {node.executable for node in nodes}, tmp_path / "prefix")
    before = os.environ["AMENT_PREFIX_PATH"]
    own = {"REBSYNC_TOLD": str(told), "ROS_LOG_DIR": str(tmp_path / "log")}
    done = subprocess.run(
        ["ros2", "launch", name, f"{name}.launch.py"],
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
            "parameters": dict(node.parameters),
            "remaps": [list(pair) for pair in node.remappings],
        }
        for node in nodes
    }, done.stdout


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
