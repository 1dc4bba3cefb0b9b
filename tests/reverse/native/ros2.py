"""A package of ROS 2 around a node: a source of its inputs, and a sink."""

from __future__ import annotations

from collections.abc import Sequence

from tests.reverse.native.ros1 import Input

_PACKAGE = """<package format="3">
  <name>closed</name>
  <depend>rclcpp</depend>
  <depend>rclpy</depend>
  <depend>std_msgs</depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
_EXECUTABLE = "add_executable(node src/node.cpp)\ntarget_link_libraries(node rclcpp)\n"
_COMPONENT = """add_library(parts SHARED src/node.cpp)
rclcpp_components_register_node(parts PLUGIN "N" EXECUTABLE node)
"""


def package(name: str, node: str, inputs: Sequence[Input]) -> dict[str, str]:
    """The files of the package: `name` is that of the node's file, `node` its text."""
    python = {"sink": _SINK, "source": _source(inputs)}
    in_cpp = name.endswith(".cpp")
    started = {"n": "node" if in_cpp else "node.py", **{n: f"{n}.py" for n in python}}
    built = _COMPONENT if "RCLCPP_COMPONENTS" in node else _EXECUTABLE
    return {
        "package.xml": _PACKAGE,
        "CMakeLists.txt": "project(closed)\n" + (built if in_cpp else ""),
        "launch/closed.launch.py": _launch(started),
        "src/node.cpp" if in_cpp else "scripts/node.py": node,
        **{f"scripts/{n}.py": text for n, text in python.items()},
    }


def _launch(started: dict[str, str]) -> str:
    nodes = [
        f'            Node(package="closed", executable="{executable}", name="{name}"),'
        for name, executable in started.items()
    ]
    return _LAUNCH.format(nodes="\n".join(nodes))


_LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
{nodes}
        ]
    )
"""
_SINK = """#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Sink(Node):
    def __init__(self):
        super().__init__("sink")
        self.last = -1
        self.create_subscription(Int32, "out", self.on_out, 9)

    def on_out(self, msg):
        self.last = msg.data


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(Sink())
"""
_SOURCE = """#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Source(Node):
    def __init__(self):
        super().__init__("source")
        self.sent = 0
{publishers}
        self.create_timer(1.0, self.on_second)

    def on_second(self):
{sends}
        if self.sent < {count}:
            self.sent += 1


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(Source())
"""


def _source(inputs: Sequence[Input]) -> str:
    topics = dict.fromkeys(topic for topic, _ in inputs)
    publishers = [f'        self.{t} = self.create_publisher(Int32, "{t}", 9)' for t in topics]
    sends = [
        f"        if self.sent == {n}:\n            self.{topic}.publish(Int32(data={value}))"
        for n, (topic, value) in enumerate(inputs)
    ]
    return _SOURCE.format(
        publishers="\n".join(publishers), sends="\n".join(sends), count=len(inputs)
    )
