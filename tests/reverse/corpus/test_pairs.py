"""The comparison of two generations, on a node that is made up."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.reverse.corpus.generations import agree, entities, plain
from tests.reverse.corpus.pairs import aligned, differences, main, read
from tests.reverse.corpus.values import Json

ROS_1 = """\
import rospy
from std_msgs.msg import Int32
class Relay:
    def __init__(self):
        self.pub = rospy.Publisher('out', Int32, queue_size=5)
        self.sub = rospy.Subscriber('~in', Int32, self.onMessage, queue_size=1)
        self.gain = rospy.get_param('~gains/first', 2)
        self.old = rospy.get_param('old', True)
    def onMessage(self, given): pass
    def run(self):
        rate = rospy.Rate(10)
rospy.init_node('relay')
"""
ROS_2 = """\
from rclpy.node import Node
from std_msgs.msg import Int32, Int64
from std_srvs.srv import Trigger
class Relay(Node):
    def __init__(self):
        super().__init__('relay')
        self.pub = self.create_publisher(Int32, 'out', 7)
        self.sub = self.create_subscription(Int64, '~/in', self._on_message, 1)
        self.declare_parameter('gains.first', 2)
        self.gain = self.get_parameter('gains.first').value
        self.create_timer(0.1, self.tick)
        self.create_service(Trigger, 'more', self.more)
    def _on_message(self, given): pass
    def tick(self): pass
    def more(self, given, answer): pass
"""


@pytest.fixture
def pair(tmp_path: Path) -> tuple[Path, Path]:
    """The two files of a node."""
    for name, text in (("one.py", ROS_1), ("two.py", ROS_2)):
        (tmp_path / name).write_text(text)
    return tmp_path / "one.py", tmp_path / "two.py"


def test_what_the_generations_write_differently_is_the_same(pair: tuple[Path, Path]) -> None:
    found = aligned(*map(read, pair))
    assert (found.shared, found.total) == (4, 7)
    assert sorted(a.kind for a, b in found.pairs if agree(a.type, b.type)) == [
        *("node", "parameter", "publisher", "timer")
    ]
    assert list(differences(found)) == [
        "depth: 5, 7 of publisher out std_msgs/Int32 (one.py:5)",
        "callback: None, tick of timer 0.1 (one.py:11)",
        "differs: subscription ~in std_msgs/Int32 (one.py:6), "
        "subscription ~in std_msgs/Int64 (two.py:8)",
        "only in ROS 1: parameter old (one.py:8)",
        "only in ROS 2: service more std_srvs/Trigger (two.py:12)",
    ]


def test_the_command(pair: tuple[Path, Path], capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*map(str, pair), "--short"]) == 0
    *_, figures, reasons = capsys.readouterr().out.splitlines()
    assert figures.split()[:3] == ["all", "4/7", "57.1%"]
    assert reasons == "no reason 3"
    assert main([str(pair[0].parent)]) == 1
    assert "no pair" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        (10, 10.0, True),
        (None, 0, False),
        (True, 1, False),
        ({"unknown": "a", "file": "x"}, {"unknown": "b", "file": "y"}, True),
        ({"parameter": "~a/b", "default": 1}, {"parameter": "a.b", "default": 1.0}, True),
        ({"parameter": "a", "default": 1}, {"parameter": "a"}, False),
        ({"one_of": ["b", "a"]}, {"one_of": ["a", "b"]}, True),
        ([1, 2], [1], False),
    ],
)
def test_values_agree(one: Json, other: Json, same: bool) -> None:
    assert agree(plain(one), plain(other)) is same


def test_parameters_below_a_name_are_as_one_that_is_a_map() -> None:
    places = {"file": "a.cpp", "line": 1, "access": "get", "default": None, "within": None}
    lists = ("nodes", "publishers", "subscriptions", "timers", "rates", "services", "clients")
    names: list[Json] = ["~axes", {"unknown": "a loop", "partial": "axes.*"}, {"unknown": "all"}]
    graph = {name: list[Json]() for name in lists}
    graph["parameters"] = [{"name": name, **places} for name in names]
    found = entities(graph, "a.cpp")
    assert [e.name for e in found] == ["axes", {"unknown": "*"}]
