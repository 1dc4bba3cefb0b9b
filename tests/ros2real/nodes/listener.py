"""A node that asks for what was sent on topics before it came: `listener.py TOPIC...`."""

from __future__ import annotations

import sys

import rclpy
from probe_interfaces.msg import Note
from rclpy.executors import ExternalShutdownException
from rclpy.qos import DurabilityPolicy, QoSProfile


def main() -> None:
    """Listens until it is told to stop."""
    rclpy.init()
    node = rclpy.create_node("tool")
    kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    for topic in sys.argv[1:]:
        node.create_subscription(Note, topic, lambda message: None, kept)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        return


if __name__ == "__main__":
    main()
