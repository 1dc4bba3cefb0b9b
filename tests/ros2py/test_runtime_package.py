"""Nodes of rclpy with the run-time part of a package that they share, in one process."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from rebsync.config import Config
from rebsync.forward.runtime_package import packages_of, runtime_packages
from tests.forward.compiling import generated, written
from tests.ros1 import test_examples as behaviour
from tests.ros1.conftest import tool
from tests.ros1.test_examples import (
    Example,
    test_each_rebec_serves_what_the_model_says,
    test_nothing_is_reported,
    test_the_run_is_one_of_the_model,
)
from tests.ros2.building import make_messages
from tests.ros2py.playing import play
from tests.ros2py.test_packages import _SCHEMA, needs_rosidl

__all__ = [
    "test_each_rebec_serves_what_the_model_says",
    "test_nothing_is_reported",
    "test_the_run_is_one_of_the_model",
]
_NAME, _TARGET = "warehouse", "ros2-py"


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the packages of an example, and those that are the run-time part."""
    folder = tmp_path_factory.mktemp("shared")
    config = Config(target=_TARGET, shared_runtime=True)
    text = (behaviour.EXAMPLES / _NAME / f"{_NAME}.rebeca").read_text(encoding="utf-8")
    written(generated(text, _NAME, config), folder, _NAME, config)
    for path, content in runtime_packages(_TARGET).items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(content)
    return folder


@pytest.fixture(scope="module")
def example(workspace: Path) -> Example:
    expected = json.loads((behaviour.EXPECTED / f"{_NAME}.json").read_text())
    return Example(_NAME, expected, play(workspace / _NAME, expected["until"] + 0.5))


@pytest.mark.parametrize("package", packages_of(_TARGET))
def test_manifests_are_of_format_3(workspace: Path, package: str) -> None:
    if not Path(_SCHEMA).exists():
        pytest.skip("no schema of package.xml")
    command = [tool("xmllint"), "--noout", "--nonet", "--schema", _SCHEMA]
    manifest = workspace / package / "package.xml"
    done = subprocess.run([*command, str(manifest)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


class TestMessages:
    """rosidl itself reads them."""

    pytestmark = needs_rosidl

    def test_rosidl_takes_every_message(self, workspace: Path, tmp_path: Path) -> None:
        own = workspace / _NAME / f"{_NAME}_interfaces"
        shared = workspace / packages_of(_TARGET)[1]
        make_messages([own, shared], tmp_path)
        made = {path.name for path in tmp_path.rglob("*__struct.hpp")}
        assert {"timing__struct.hpp", "announcement__struct.hpp"} < made
