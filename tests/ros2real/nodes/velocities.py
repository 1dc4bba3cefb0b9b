"""Writes what a robot is told: `velocities.py TOPIC FILE`, until it is told to stop.

A line for each velocity: when it was heard, and how fast it is.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException


def main(topic: str, path: str) -> None:
    rclpy.init()
    node = rclpy.create_node("velocities")
    with Path(path).open("w", buffering=1) as file:

        def hear(twist: Twist) -> None:
            file.write(f"{time.time()} {twist.linear.x} {twist.angular.z}\n")

        node.create_subscription(Twist, topic, hear, 1000)
        try:
            while True:  # rclpy of Humble may not wake up for SIGTERM
                rclpy.spin_once(node, timeout_sec=0.5)
        except (KeyboardInterrupt, ExternalShutdownException):
            return


if __name__ == "__main__":
    main(*sys.argv[1:])
