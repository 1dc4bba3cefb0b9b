"""Has a rebec hear late what others announce: `deaf.py REBEC SECONDS`.

It announces itself on `REBEC/startup`, and this node passes on what is said there and elsewhere.
"""

from __future__ import annotations

import sys

import rclpy
from probe_interfaces.msg import Announcement
from rclpy.clock import Clock, ClockType
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile

NANOSECONDS = 10**9  # of a second
PERIOD = 0.005  # s, between two looks at what is due
KEPT = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Deaf:
    """Stands between a rebec and all others, on the simulated clock."""

    def __init__(self, node: Node, rebec: str, seconds: float) -> None:
        self.node = node
        self.rebec = rebec
        self.late = round(seconds * NANOSECONDS)
        self.waiting: list[tuple[int, Announcement]] = []
        self.all = node.create_publisher(Announcement, "/startup", KEPT)
        self.own = node.create_publisher(Announcement, f"/{rebec}/startup", KEPT)
        node.create_subscription(Announcement, "/startup", self.hear, KEPT)
        node.create_subscription(Announcement, f"/{rebec}/startup", self.say, KEPT)
        node.create_timer(PERIOD, self.pass_on, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def say(self, message: Announcement) -> None:
        if message.rebec == self.rebec:
            self.all.publish(message)

    # This node may not have heard of the time yet, of which the sender has.
    def hear(self, message: Announcement) -> None:
        if message.rebec != self.rebec:
            now = max(self.node.get_clock().now().nanoseconds, message.clock)
            self.waiting.append((now + self.late, message))

    def pass_on(self) -> None:
        now = self.node.get_clock().now().nanoseconds
        while self.waiting and self.waiting[0][0] <= now:
            self.own.publish(self.waiting.pop(0)[1])


def main(rebec: str, seconds: float) -> None:
    """Passes on until it is told to stop."""
    rclpy.init()
    simulated = Parameter("use_sim_time", Parameter.Type.BOOL, True)
    node = rclpy.create_node("deaf", parameter_overrides=[simulated])
    deaf = Deaf(node, rebec, seconds)
    try:
        rclpy.spin(deaf.node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]))
