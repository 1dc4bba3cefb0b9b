"""A bumper whose messages may be lost: tells what a subscription asks for, and whether it hears."""

from __future__ import annotations

import time

import rclpy
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import Bool

_PATIENCE = 60.0  # s, until somebody has subscribed
_MOMENT = 3.0  # s, in which what matches is matched


def main() -> None:
    """`RELIABLE 0`: the reliability that is asked for, and how many hear it."""
    rclpy.init()
    node = rclpy.create_node("bumper")
    touches = node.create_publisher(Bool, "/bump", qos_profile_sensor_data)
    limit = time.monotonic() + _PATIENCE
    while not node.get_subscriptions_info_by_topic("/bump") and time.monotonic() < limit:
        time.sleep(0.1)
    limit = time.monotonic() + _MOMENT
    while time.monotonic() < limit:
        touches.publish(Bool(data=True))
        time.sleep(0.05)
    for asked in node.get_subscriptions_info_by_topic("/bump"):
        print(asked.qos_profile.reliability.name, touches.get_subscription_count())


if __name__ == "__main__":
    main()
