"""What a callback asks of values of unknown types is listed where Python raises."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

from rebsync.reverse.recovery import extract
from rebsync.source import Source

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_ROWS = tomllib.loads(Path(__file__).with_name("unknown_types.toml").read_text("utf-8"))
_PACKAGE = "<package><name>n</name><depend>{}</depend><depend>std_msgs</depend></package>"
_NODES = {
    "rospy": """
import rospy
from std_msgs.msg import Int32
{top}
class Node:
{methods}
    def __init__(self):
        self.n = 0
        {made}
        self.out = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("go", Int32, self.on_go)

    def on_go(self, message):
{body}
        self.out.publish(Int32(data=1))


if __name__ == "__main__":
    rospy.init_node("n")
    node = Node()
    rospy.spin()
""",
    "rclpy": """
import rclpy
import rclpy.node
from std_msgs.msg import Int32
{top}
class Node(rclpy.node.Node):
{methods}
    def __init__(self):
        super().__init__("n")
        self.n = 0
        {made}
        self.out = self.create_publisher(Int32, "out", 1)
        self.create_subscription(Int32, "go", self.on_go, 1)

    def on_go(self, message):
{body}
        self.out.publish(Int32(data=1))


def main():
    rclpy.init()
    node = Node()
    rclpy.spin(node)
""",
}


def _text(library: str, row: dict[str, str]) -> str:
    lines = "\n".join(f"        {line}" for line in row["body"].split("\n"))
    given = {key: row.get(key, "") for key in ("top", "methods", "made")}
    return _NODES[library].format(body=lines, **given)


@pytest.mark.parametrize("library", _NODES)
@pytest.mark.parametrize("name", _ROWS)
def test_what_may_raise_is_listed(name: str, library: str) -> None:
    files = {"package.xml": _PACKAGE.format(library), "scripts/n.py": _text(library, _ROWS[name])}
    found = extract({path: Source(path, text) for path, text in files.items()}).findings
    listed = [f.why for f in found if f.grade.value == "unreadable"]
    assert bool(listed) == _ROWS[name].get("raises", False), listed


@pytest.mark.parametrize("name", _ROWS)
def test_python_raises_as_the_rows_say(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    publisher = SimpleNamespace(publish=lambda message: None)
    stand_in = ModuleType("rospy")
    vars(stand_in).update(Publisher=lambda *_, **__: publisher, Subscriber=lambda *_: None)
    messages = ModuleType("std_msgs.msg")
    vars(messages).update(Int32=lambda data: SimpleNamespace(data=data))
    for module in (stand_in, ModuleType("std_msgs"), messages):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    space: dict[str, object] = {"__name__": name}
    monkeypatch.setitem(sys.modules, name, ModuleType(name))  # which data classes look at
    exec(compile(_text("rospy", _ROWS[name]), name, "exec", dont_inherit=True), space)
    node = space["Node"]()  # type: ignore[operator]
    raised = False
    try:
        for data in (0, 1, -3, 100):
            node.on_go(SimpleNamespace(data=data))
    except (ArithmeticError, AttributeError, TypeError, ValueError):
        raised = True
    assert raised == _ROWS[name].get("raises", False)
