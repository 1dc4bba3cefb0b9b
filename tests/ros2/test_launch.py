"""Launch files of ROS 2 in Python: what is declared is read, what is computed is unknown."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.config import Config
from rebsync.reverse.launch.launch_files_ros2 import read_ros2_launch
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.unknowns import Open
from rebsync.source import Source
from tests.forward.compiling import generated, written
from tests.ros2.launching import launched

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
         parameters=[params, common, {"knownrebecs.c": "c", "x": -1, "on": ParameterValue("on")},
                     {"n": "2", "text": ParameterValue("2", value_type=str)}],
         remappings=[("~/c/go", "c/go")]),
])"""
    )
    (node,) = launch.nodes
    assert (node.name, node.namespace, node.package, node.type) == (
        *("robot1", "/hall/", "a", "robot_node"),
    )
    assert {p.name: p.value for p in node.parameters} == {
        "env/e": 3,
        "mailbox/slack": 0.25,
        "mailbox/rebecs": ("robot1", "robot2"),
        "knownrebecs/c": "c",
        "x": -1,
        "on": "on",
        "n": 2,
        "text": "2",
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


# --- generated launch files ---------------------------------------------------------------------

_MODEL = """
env int limit = 3;
reactiveclass A(3) {
  knownrebecs { A other; }
  A(int n) { if (n < limit) { self.begin(); } }
  msgsrv begin() { other.go(); }
  msgsrv go() {}
  @Sensor msgsrv look() { boolean b = ?(true, false); self.look() after(1); }
}
main { A a(b):(1); A b(a):(2); }
"""


@pytest.fixture(params=["ros2-cpp", "ros2-py"])
def package(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    config = Config(target=request.param, time_unit=0.25)
    files = generated(_MODEL, "pair", config)
    folder = written(files, tmp_path, "pair", config)
    return folder / "pair" if request.param == "ros2-py" else folder


def test_arguments_reach_every_node(package: Path) -> None:
    own = package / "own.yaml"
    own.write_text("/**:\n  ros__parameters:\n    env:\n      limit: 7\n")
    nodes = launched(
        package, namespace="hall", use_sim_time="true", log_level="debug", params_file=str(own)
    )
    assert {n.name for n in nodes} >= {"a", "b"}
    for node in nodes:
        assert node.namespace == "hall"
        assert node.ros_arguments == ["--log-level", "debug"]
        assert node.parameters["use_sim_time"] is True
        assert node.parameters["env.limit"] == 7
        assert node.parameters["mailbox.time_unit"] == 0.25  # which the user's file leaves alone


def test_without_arguments_nothing_changes(package: Path) -> None:
    for node in launched(package):
        assert (node.namespace, node.ros_arguments) == ("", ["--log-level", "info"])
        assert node.parameters["use_sim_time"] is False
        assert node.parameters["env.limit"] == 3


def test_other_defaults_are_read(package: Path) -> None:
    """A namespace as the default of its argument is one; the file of parameters is followed."""
    path = f"launch/{package.name}.launch.py"
    text = (package / path).read_text()
    edited = text.replace('default_value=""', 'default_value="hall"')
    assert edited != text
    files = {"config/params.yaml": Source("config/params.yaml", _PARAMS)}
    launch = read_ros2_launch(Source(path, edited), files.get, package.name)
    assert launch.unknowns == ()
    assert {n.namespace for n in launch.nodes} == {"/hall/"}
    assert {p.name: p.value for p in launch.parameters} == {"/env/e": 3, "/mailbox/slack": 0.25}
