"""Launch files of ROS 2 in Python: what is declared is read, what is computed is unknown."""

from __future__ import annotations

from rebsync.reverse.launch.launch_files_ros2 import read_ros2_launch
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.unknowns import Open
from rebsync.source import Source

_HEAD = """
import os
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
"""
_PARAMS = """
/**:
  ros__parameters:
    env:
      e: 3
    mailbox:
      slack: 0.25
"""


def _read(body: str) -> Launch:
    indented = "".join(f"    {line}\n" for line in body.strip().split("\n"))
    files = {"config/params.yaml": Source("config/params.yaml", _PARAMS)}
    return read_ros2_launch(Source("launch/a.launch.py", _HEAD + indented), files.get)


def test_names_bound_once_stand_for_their_values() -> None:
    launch = _read(
        """
who = "robot1"
params = PathJoinSubstitution([FindPackageShare("a"), "config", "params.yaml"])
common = {"mailbox": {"rebecs": ["robot1", "robot2"]}}
return LaunchDescription([
    # rebsync: annotation @priority(1)
    # rebsync: rebec R1
    Node(package="a", executable="robot_node", name=who, namespace="hall",
         parameters=[params, common, {"knownrebecs.c": "c", "x": -1, "on": ParameterValue("on")}],
         remappings=[("~/c/go", "c/go")]),
])"""
    )
    (node,) = launch.nodes
    assert (node.name, node.namespace, node.package, node.type) == (
        *("robot1", "/hall/", "a", "robot_node"),
    )
    assert {p.name: p.value for p in node.parameters} == {
        "mailbox/rebecs": ("robot1", "robot2"),
        "knownrebecs/c": "c",
        "x": -1,
        "on": "on",
    }
    assert [(r.private, r.target) for r in node.remaps] == [("~/c/go", "c/go")]
    assert node.markers == ("annotation @priority(1)", "rebec R1")
    assert {p.name: p.value for p in launch.parameters} == {"/env/e": 3, "/mailbox/slack": 0.25}
    assert launch.unknowns == ()


def test_what_is_computed_is_unknown_with_its_place() -> None:
    launch = _read(
        """
names = ["a", "b"]
return LaunchDescription([
    Node(package="a", executable="n", name=f"r{len(names)}", parameters=[{"x": os.getpid()}],
         condition=IfCondition(LaunchConfiguration("sim"))),
])"""
    )
    (node,) = launch.nodes
    assert isinstance(node.name, Open)
    assert [isinstance(p.value, Open) for p in node.parameters] == [True]
    assert node.only_if != ()
    places = [u.source.text[u.span.start : u.span.end] for u in launch.unknowns]
    assert places == ['f"r{len(names)}"', "os.getpid()"]


def test_a_name_bound_twice_is_unknown() -> None:
    launch = _read(
        """
name = "a"
name = "b"
return LaunchDescription([Node(package="p", executable="n", name=name)])"""
    )
    assert isinstance(launch.nodes[0].name, Open)


def test_a_file_that_is_no_python_is_listed() -> None:
    launch = read_ros2_launch(Source("a.launch.py", "def ("), lambda _: None)
    assert launch.nodes == ()
    assert "no Python" in launch.unknowns[0].why
