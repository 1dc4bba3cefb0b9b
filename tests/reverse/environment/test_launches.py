"""One node, started by launch files that differ: what they set and rename decides a property.

A row of `launches.toml` has a launch file, what lies beside it, and the verdict on the question
whether the node ever publishes more than 3, the default of its parameter. It was written before
the first answer. `unknown` is what nobody can tell from these files: the answer is "undetermined",
or a run of a model that is said to do more than the code.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from rebsync.cli import main

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_ROWS = tomllib.loads((Path(__file__).parent / "launches.toml").read_text(encoding="utf-8"))
_MANIFEST = """<package format="3">
  <name>guarded</name>
  <version>0.1.0</version>
  <description>A node that people wrote.</description>
  <maintainer email="who@example.org">Who</maintainer>
  <license>MIT</license>
  {needs}
</package>
"""
_ROSPY = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class Guard:
    def __init__(self):
        self.limit = rospy.get_param("{parameter}", 3)
        self.out = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("in", Int32, self.on_number, queue_size=1)

    def on_number(self, msg):
        if 0 <= msg.data <= self.limit:
            self.out.publish(Int32(data=msg.data))


if __name__ == "__main__":
    rospy.init_node("guard")
    Guard()
    rospy.spin()
"""
_BUILD = """cmake_minimum_required(VERSION 3.0)
project(guarded)
find_package(catkin REQUIRED COMPONENTS rospy std_msgs)
catkin_package()
catkin_install_python(PROGRAMS scripts/node.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
"""
_RCLPY = """import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Guard(Node):
    def __init__(self):
        super().__init__("guard")
        self.declare_parameter("limit", 3)
        self.limit = self.get_parameter("limit").value
        self.out = self.create_publisher(Int32, "out", 10)
        self.create_subscription(Int32, "in", self.on_number, 10)

    def on_number(self, msg):
        if 0 <= msg.data <= self.limit:
            self.out.publish(Int32(data=msg.data))


def main():
    rclpy.init()
    rclpy.spin(Guard())
"""
_SETUP = """from setuptools import setup

setup(
    name="guarded",
    version="0.1.0",
    packages=["guarded"],
    entry_points={"console_scripts": ["guard = guarded.guard:main"]},
)
"""


def _files(row: Mapping[str, Any]) -> dict[str, str]:
    """The package that a row is of."""
    if row["ros"] == 1:
        own = {
            "package.xml": _MANIFEST.format(
                needs="<depend>rospy</depend><depend>std_msgs</depend>"
            ),
            "CMakeLists.txt": _BUILD,
            "scripts/node.py": _ROSPY.format(parameter=row.get("parameter", "~limit")),
        }
    else:
        build = "<export><build_type>ament_python</build_type></export>"
        needs = f"<depend>rclpy</depend><depend>std_msgs</depend>{build}"
        own = {
            "package.xml": _MANIFEST.format(needs=needs),
            "setup.py": _SETUP,
            "resource/guarded": "",
            "guarded/__init__.py": "",
            "guarded/guard.py": _RCLPY,
        }
    name = row.get("file", "a.launch" if row["ros"] == 1 else "a.launch.py")
    return {**own, f"launch/{name}": row["text"], **row.get("more", {})}


@pytest.mark.parametrize("row", _ROWS["launch"], ids=lambda r: f"{r['name']} {r['ros']}")
def test_what_is_set_decides(
    row: Mapping[str, Any], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = tmp_path / "guarded"
    for path, text in _files(row).items():
        target = package / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")
    main(["ask", str(package), "never out.data > 3", "--format", "json"])
    out, err = capsys.readouterr()
    found = json.loads(out)
    is_loose = any("which the model does more" in c for c in found["caveats"])
    if row["verdict"] == "unknown":
        assert found["verdict"] == "undetermined" or (found["verdict"] == "violated" and is_loose)
    else:
        assert (found["verdict"], is_loose) == (row["verdict"], False), err
