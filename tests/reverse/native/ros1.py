"""A package of ROS 1 around a node: a source of its inputs, and a sink."""

from __future__ import annotations

from collections.abc import Sequence

Input = tuple[str, int]


def package(name: str, node: str, inputs: Sequence[Input]) -> dict[str, str]:
    """The files of the package: `name` is that of the node's file, `node` its text."""
    python = {"sink": _SINK, "source": _source(inputs)}
    started = "node" if name.endswith(".cpp") else "node.py"
    nodes = {"n": started, **{name: f"{name}.py" for name in python}}
    lines = (f'  <node pkg="closed" type="{t}" name="{n}"/>' for n, t in nodes.items())
    files = {f"scripts/{name}.py": text for name, text in python.items()}
    where = "src/node.cpp" if name.endswith(".cpp") else "scripts/node.py"
    return {
        "package.xml": "<package><name>closed</name></package>\n",
        "CMakeLists.txt": "project(closed)\nadd_executable(node src/node.cpp)\n",
        "launch/closed.launch": "\n".join(["<launch>", *lines, "</launch>", ""]),
        where: node,
        **files,
    }


_SINK = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class Sink(object):
    def __init__(self):
        self.last = -1
        rospy.Subscriber("out", Int32, self.on_out, queue_size=9)

    def on_out(self, msg):
        self.last = msg.data


if __name__ == "__main__":
    rospy.init_node("sink")
    Sink()
    rospy.spin()
"""
_SOURCE = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class Source(object):
    def __init__(self):
        self.sent = 0
{publishers}
        rospy.Timer(rospy.Duration(1), self.on_second)

    def on_second(self, event):
{sends}
        if self.sent < {count}:
            self.sent += 1


if __name__ == "__main__":
    rospy.init_node("source")
    Source()
    rospy.spin()
"""


def _source(inputs: Sequence[Input]) -> str:
    topics = dict.fromkeys(topic for topic, _ in inputs)
    publishers = [f'        self.{t} = rospy.Publisher("{t}", Int32, queue_size=9)' for t in topics]
    sends = [
        f"        if self.sent == {n}:\n            self.{topic}.publish({value})"
        for n, (topic, value) in enumerate(inputs)
    ]
    return _SOURCE.format(
        publishers="\n".join(publishers), sends="\n".join(sends), count=len(inputs)
    )
