"""What a laser, a bumper and a battery publish: `scanner.py`, until it is told to stop."""

from __future__ import annotations

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool, Int32

PERIOD = 0.05  # s, of the real clock


def main() -> None:
    """Publishes one obstacle, near and touched; a laser's messages may be lost, others not."""
    rclpy.init()
    node = rclpy.create_node("scanner")
    scans = node.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
    touches = node.create_publisher(Bool, "bumper", 10)
    levels = node.create_publisher(Int32, "battery", 10)

    def tell() -> None:
        scans.publish(LaserScan(ranges=[0.5]))
        touches.publish(Bool(data=True))
        levels.publish(Int32(data=40))

    node.create_timer(PERIOD, tell)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        return


if __name__ == "__main__":
    main()
