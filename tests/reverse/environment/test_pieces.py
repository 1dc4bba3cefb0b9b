"""Small nodes that differ in one thing: what harms a property, and its harmless twin beside it.

A row of `pieces/*.toml` has the parts that are put into one of the nodes below. Its verdict was
written before the first answer, by reading the code: where it is undetermined a run of the code
breaks the property, or may, and no run of the model does.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from dataclasses import field
from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.records import dataclass
from tests.roundtrip.edits.drawing import drawn

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_STATUS = {"satisfied": 0, "violated": 3, "undetermined": 4}
_MANIFEST = """<package format="2">
  <name>piece</name>
  <version>0.1.0</version>
  <description>A node that people wrote.</description>
  <maintainer email="who@example.org">Who</maintainer>
  <license>MIT</license>
  <depend>roscpp</depend>
  <depend>rospy</depend>
  <depend>std_msgs</depend>
</package>
"""
_BUILD = """cmake_minimum_required(VERSION 3.0)
project(piece)
find_package(catkin REQUIRED COMPONENTS roscpp std_msgs)
catkin_package()
add_executable(gate src/gate.cpp)
target_link_libraries(gate ${catkin_LIBRARIES})
"""
_AMENT = """cmake_minimum_required(VERSION 3.8)
project(piece)
find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
find_package(std_msgs REQUIRED)
add_executable(gate src/gate.cpp)
ament_target_dependencies(gate rclcpp std_msgs)
ament_package()
"""
_PYTHON = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32
{module}

class Gate:
    def __init__(self):
        self.level = 0
        self.out = rospy.Publisher("out", Int32, queue_size=10)
{start}
        rospy.Subscriber("go", Int32, self.on_go)

    def bump(self, *args):
        self.level = 7

{methods}
    def on_go(self, msg):
{body}
        self.out.publish(Int32(data={value}))


if __name__ == "__main__":
    rospy.init_node("gate")
    gate = Gate()
    rospy.spin()
"""
_RCLPY = """#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32
{module}

class Gate(Node):
    def __init__(self):
        super().__init__("gate")
        self.level = 0
        self.out = self.create_publisher(Int32, "out", 10)
{start}
        self.create_subscription(Int32, "go", self.on_go, 10)

    def bump(self, *args):
        self.level = 7

{methods}
    def on_go(self, msg):
{body}
        self.out.publish(Int32(data={value}))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(Gate())
"""
_CPP = """#include <ros/ros.h>
#include <std_msgs/Int32.h>
{module}
class Gate {{
 public:
  Gate() {{
    out_ = nh_.advertise<std_msgs::Int32>("out", 10);
    sub_ = nh_.subscribe("go", 10, &Gate::onGo, this);
{start}
  }}

 private:
  void onGo(const std_msgs::Int32::ConstPtr& msg) {{
{body}
    std_msgs::Int32 told;
    told.data = 1;
    out_.publish(told);
  }}
{methods}
  ros::NodeHandle nh_;
  ros::Publisher out_;
  ros::Subscriber sub_;
}};

int main(int argc, char** argv) {{
  ros::init(argc, argv, "gate");
  Gate gate;
  ros::spin();
}}
"""
_RCLCPP = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
{module}
class Gate : public rclcpp::Node {{
 public:
  Gate() : Node("gate") {{
    out_ = create_publisher<std_msgs::msg::Int32>("out", 10);
    sub_ = create_subscription<std_msgs::msg::Int32>(
        "go", 10, std::bind(&Gate::onGo, this, std::placeholders::_1));
{start}
  }}

 private:
  void onGo(const std_msgs::msg::Int32::ConstSharedPtr& msg) {{
{body}
    std_msgs::msg::Int32 told;
    told.data = 1;
    out_->publish(told);
  }}
{methods}
  rclcpp::Publisher<std_msgs::msg::Int32>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr sub_;
}};

int main(int argc, char** argv) {{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Gate>());
  rclcpp::shutdown();
}}
"""


@dataclass(frozen=True, slots=True)
class Piece:
    """A row: the parts of a node, or its whole `text`; of some `clients`, or of all of the file.

    `build` is what its CMakeLists.txt says besides, `more` are other files of the package.
    """

    name: str
    verdict: str
    module: str = ""
    start: str = ""
    methods: str = ""
    body: str = ""
    text: str = ""
    clients: tuple[str, ...] = ()
    build: str = ""
    more: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Table:
    """A file of rows, with the question that is asked of all of them."""

    ask: str
    client: str
    pieces: tuple[Piece, ...]

    @property
    def is_cpp(self) -> bool:
        """Whether its nodes are of C++."""
        return self.client in ("roscpp", "rclcpp")


_IN_CI = "CI" in os.environ  # where each row is of one of its client libraries


def _tables(path: Path) -> Iterator[tuple[str, Table]]:
    """A file of rows, once for each client library that its nodes are of."""
    found = tomllib.loads(path.read_text(encoding="utf-8"))
    pieces = tuple(Piece(**row) for row in found["piece"])
    first = "roscpp" if path.stem.startswith("cpp") else "rospy"
    every = tuple(found.get("clients", [first]))
    for client in every:
        name = path.stem if client == first else f"{path.stem}_{client}"
        asked = tuple(p for p in pieces if client in _clients(p, every))
        yield name, Table(found["ask"], client, asked)


def _clients(piece: Piece, every: tuple[str, ...]) -> tuple[str, ...]:
    """The client libraries that a row is tried with: in CI one of them, by its name."""
    clients = piece.clients or every
    return (clients[drawn("client", piece.name, len(clients))],) if _IN_CI else clients


_FILES = sorted((Path(__file__).parent / "pieces").glob("*.toml"))
_TABLES = {name: table for path in _FILES for name, table in _tables(path)}
_NODES = {"roscpp": _CPP, "rclcpp": _RCLCPP, "rospy": _PYTHON, "rclpy": _RCLPY}
_ROWS = [
    pytest.param(table, piece, id=f"{name}-{piece.name}")
    for name, table in _TABLES.items()
    for piece in table.pieces
]


def _written(table: Table, piece: Piece, package: Path) -> None:
    """A package with the node of a row."""
    own = {"rclpy": "rospy", "rclcpp": "roscpp"}.get(table.client, table.client)
    manifest = _MANIFEST.replace(own, table.client)
    (package / "package.xml").write_text(manifest, encoding="utf-8")
    path = package / ("src/gate.cpp" if table.is_cpp else "scripts/gate.py")
    path.parent.mkdir()
    if table.is_cpp:
        build = _AMENT if table.client == "rclcpp" else _BUILD
        (package / "CMakeLists.txt").write_text(build + piece.build, encoding="utf-8")
    depth = 4 if table.is_cpp else 8
    text = piece.text or _NODES[table.client].format(
        module=piece.module,
        start=_indented(piece.start, depth),
        methods=_indented(piece.methods, depth // 2 if not table.is_cpp else 2),
        body=_indented(piece.body, depth),
        value="1" if "leads to" in table.ask else "self.level",
    )
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)
    for name, other in piece.more.items():
        (package / name).parent.mkdir(exist_ok=True)
        (package / name).write_text(other, encoding="utf-8")


def _indented(text: str, depth: int) -> str:
    return "\n".join(" " * depth + line if line else "" for line in text.splitlines())


@pytest.mark.parametrize(("table", "piece"), _ROWS)
def test_what_may_harm_is_not_satisfied(table: Table, piece: Piece, tmp_path: Path) -> None:
    _written(table, piece, tmp_path)
    status = main(["ask", str(tmp_path), table.ask, "-o", str(tmp_path / "answer.txt")])
    assert status == _STATUS[piece.verdict], (tmp_path / "answer.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("path", _FILES, ids=lambda path: path.stem)
def test_each_file_has_what_harms_and_what_does_not(path: Path) -> None:
    rows = tomllib.loads(path.read_text(encoding="utf-8"))["piece"]
    assert {"satisfied", "undetermined"} <= {row["verdict"] for row in rows}
