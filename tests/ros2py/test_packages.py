"""The two packages of a system of rclpy nodes please the tools of ROS 2."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from tests.ros1 import test_examples as behaviour
from tests.ros1.conftest import tool
from tests.ros2.building import make_messages, missing_rosidl
from tests.ros2py.conftest import probe_packages

_NAME = "warehouse"
_REASON = missing_rosidl()
_SCHEMA = "/usr/share/ament_xmllint/xml-catalog/download.ros.org/schema/package_format3.xsd"
needs_rosidl = [
    pytest.mark.ros2tools,
    pytest.mark.skipif(
        _REASON is not None and os.environ.get("CI") != "true", reason=_REASON or "rosidl is here"
    ),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the packages of nodes and of messages."""
    example = behaviour.EXAMPLES / _NAME
    return behaviour.example_package(example, "ros2-py", tmp_path_factory.mktemp("packages"))


def test_there_are_two_packages(folder: Path) -> None:
    found = sorted(p.parent.name for p in folder.glob("*/package.xml"))
    assert found == [_NAME, f"{_NAME}_interfaces"]


def test_every_node_of_the_launch_file_is_an_entry_point(folder: Path) -> None:
    launch = (folder / _NAME / "launch" / f"{_NAME}.launch.py").read_text()
    setup = (folder / _NAME / "setup.py").read_text()
    for name in ("carrier_node", "dispatcher_node", "lifter_node", "lifter_stand_in"):
        assert f'executable="{name}"' in launch
        assert f'"{name} = {_NAME}.{name}:main"' in setup
        assert (
            "@stoppable\ndef main() -> None:" in (folder / _NAME / _NAME / f"{name}.py").read_text()
        )


@pytest.mark.parametrize("package", [_NAME, f"{_NAME}_interfaces"])
def test_manifests_are_of_format_3(folder: Path, package: str) -> None:
    if not Path(_SCHEMA).exists() and _REASON is not None:
        pytest.skip("no schema of package.xml")
    command = [tool("xmllint"), "--noout", "--nonet", "--schema", _SCHEMA]
    manifest = folder / package / "package.xml"
    done = subprocess.run([*command, str(manifest)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


class TestMessages:
    """rosidl itself reads them."""

    pytestmark = needs_rosidl

    def test_rosidl_takes_every_message(self, folder: Path, tmp_path: Path) -> None:
        package = folder / f"{_NAME}_interfaces"
        make_messages([package], tmp_path)
        made = list((tmp_path / package.name).rglob("*__struct.hpp"))
        assert len(made) == len(list(package.glob("msg/*.msg"))) > 10


def test_the_packages_that_run_scripts_have_all_messages(tmp_path: Path) -> None:
    """Those that only a real ROS 2 builds."""
    folder = probe_packages(tmp_path) / "probe_interfaces"
    build_file = (folder / "CMakeLists.txt").read_text()
    messages = {f"msg/{file.name}" for file in (folder / "msg").iterdir()}
    assert {message for message in messages if message in build_file} == messages != set()
