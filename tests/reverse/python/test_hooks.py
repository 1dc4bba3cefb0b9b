"""Functions that a library calls for other reasons: listed where they are handed over."""

from __future__ import annotations

import pytest

from rebsync.reverse.findings import Findings
from rebsync.reverse.python.recovery import PythonCode, read_python
from rebsync.source import Source

ROSPY = "import rospy, actionlib\nfrom dynamic_reconfigure.server import Server\n"
RCLPY = """\
import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
"""
# What stands in a function `run` of a class, and what is listed: the call, and the functions.
CASES = {
    "shut down": (ROSPY, "rospy.on_shutdown(self.stop)", "on_shutdown: Own.stop"),
    "by name": (ROSPY, "rospy.on_shutdown(h=lambda: None)", "on_shutdown: lambda"),
    "action server": (
        ROSPY,
        "self.s = actionlib.SimpleActionServer('a', T, execute_cb=self.run, auto_start=False)",
        "SimpleActionServer: Own.run",
    ),
    "action server by place": (
        ROSPY,
        "self.s = actionlib.SimpleActionServer('a', T, self.run, False)",
        "SimpleActionServer: Own.run",
    ),
    "no function": (ROSPY, "self.s = actionlib.SimpleActionServer('a', T, None, False)", ""),
    "goal": (
        ROSPY,
        "c = actionlib.SimpleActionClient('a', T); c.send_goal(1, self.stop, None, self.run)",
        "send_goal: Own.stop, Own.run",
    ),
    "goal alone": (ROSPY, "c = actionlib.SimpleActionClient('a', T); c.send_goal(1)", ""),
    "reconfigure": (ROSPY, "self.s = Server(T, self.stop)", "Server: Own.stop"),
    "parameters": (
        RCLPY,
        "self.add_on_set_parameters_callback(self.stop)",
        "add_on_set_parameters_callback: Own.stop",
    ),
    "context": (RCLPY, "self.context.on_shutdown(self.stop)", "on_shutdown: Own.stop"),
    "of the library": (
        RCLPY,
        "rclpy.get_default_context().on_shutdown(self.stop)",
        "on_shutdown: Own.stop",
    ),
    "callbacks of an action": (
        RCLPY,
        "ActionServer(self, T, 'a', self.run, cancel_callback=self.stop)",
        "ActionServer: Own.run, Own.stop",
    ),
    "feedback": (
        RCLPY,
        "ActionClient(self, T, 'a').send_goal_async(1, feedback_callback=self.stop)",
        "send_goal_async: Own.stop",
    ),
    "future": (RCLPY, "self.f.add_done_callback(self.stop)", "add_done_callback: Own.stop"),
    "events": (
        RCLPY,
        "SubscriptionEventCallbacks(deadline=self.stop)",
        "SubscriptionEventCallbacks: Own.stop",
    ),
    "not known": (RCLPY, "self.f.add_done_callback(given)", "add_done_callback: Own"),
    "listener": (
        ROSPY,
        "self.p = rospy.Publisher('t', T, self, queue_size=1)",
        "Publisher: Own",
    ),
    "one of one's own": (RCLPY, "self.send_goal(1, 2)", ""),
    "of the class above": (RCLPY, "return super().on_shutdown(given)", ""),
    "of another library": (RCLPY, "import x; x.send_goal(1, self.stop)", ""),
}


@pytest.mark.parametrize("case", CASES)
def test_what_is_handed_over_is_listed(case: str) -> None:
    head, statement, expected = CASES[case]
    base = "Node" if head == RCLPY else "object"
    text = (
        f"{head}class Own({base}):\n  def run(self, given):\n    {statement}\n"
        "  def stop(self, *given): pass\n  def send_goal(self, *given): pass\n"
    )
    findings = Findings()
    read_python(PythonCode.of({"a.py": Source("a.py", text)}, findings), findings)
    assert _hooks(findings) == ([expected] if expected else [])


def test_changes_of_state_are_listed() -> None:
    text = (
        "from rclpy.lifecycle import Node as Managed\nclass Own(Managed):\n"
        "  def on_configure(self, state): return super().on_configure(state)\n"
        "  def on_other(self, state): pass\nclass Other:\n  def on_configure(self): pass\n"
    )
    findings = Findings()
    read_python(PythonCode.of({"a.py": Source("a.py", text)}, findings), findings)
    assert _hooks(findings) == ["on_configure: Own.on_configure"]


def _hooks(findings: Findings) -> list[str]:
    return [f"{f.text}: {f.within}" for f in findings.all if "calls functions of" in f.why]
