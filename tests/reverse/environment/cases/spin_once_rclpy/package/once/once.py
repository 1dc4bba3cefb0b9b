"""Lets messages be served once in each round, and publishes behind that."""

import rclpy
from std_msgs.msg import Int32


def main():
    rclpy.init()
    node = rclpy.create_node("once")
    out = node.create_publisher(Int32, "out", 10)
    node.create_subscription(Int32, "cmd", lambda msg: None, 10)
    while rclpy.ok():
        rclpy.spin_once(node)
        out.publish(Int32(data=1))
