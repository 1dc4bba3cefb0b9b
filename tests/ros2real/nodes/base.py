"""A robot's base: drives as it is told, but only so much of the way, and tells its odometry.

`base.py NAME GRIP FASTEST TOLD SECONDS`, with the folder of the module `wheels` in PYTHONPATH.
"""

from __future__ import annotations

import json
import math
import sys
import time

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float64
from wheels import Wheels

PERIOD = 0.02  # s


class Base(Node):
    """Tells odometry until it has driven some metres."""

    def __init__(self, name: str, wheels: Wheels, told: float) -> None:
        super().__init__("base")
        self.wheels, self.told = wheels, told
        self.twist, self.last = Twist(), time.monotonic()
        self.velocities: list[float] = []
        self.differences: list[float] = []
        kept = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.odometry = self.create_publisher(Odometry, f"/{name}/odom", 10)
        self.create_subscription(Twist, f"/{name}/cmd_vel", self.hear, 100)
        self.create_subscription(Float64, f"/{name}/drive/difference", self.note, kept)
        self.create_timer(PERIOD, self.step)

    def hear(self, twist: Twist) -> None:
        self.twist = twist
        self.velocities.append(twist.linear.x)

    def note(self, difference: Float64) -> None:
        self.differences.append(difference.data)

    def step(self) -> None:
        """Drives on as long as it has not."""
        now, told = time.monotonic(), self.twist
        self.wheels.step(told.linear.x, told.linear.y, told.angular.z, now - self.last)
        self.last = now
        if math.hypot(*self.wheels.driven()) >= self.told:
            return
        msg = Odometry()
        msg.header.stamp = self.get_clock().now().to_msg()
        msg.pose.pose.position.x, msg.pose.pose.position.y = self.wheels.x, self.wheels.y
        msg.pose.pose.orientation.z = math.sin(self.wheels.heading / 2)
        msg.pose.pose.orientation.w = math.cos(self.wheels.heading / 2)
        self.odometry.publish(msg)


def main(name: str, grip: float, fastest: float, told: float, seconds: float) -> None:
    rclpy.init()
    base = Base(name, Wheels(grip, fastest), told)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        rclpy.spin_once(base, timeout_sec=PERIOD)
    facts = {
        "driven": base.wheels.driven(),
        "differences": base.differences,
        "last": base.velocities[-1] if base.velocities else None,
    }
    print(json.dumps(facts))


if __name__ == "__main__":
    main(sys.argv[1], *map(float, sys.argv[2:]))
