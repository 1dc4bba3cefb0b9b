"""A node that a function makes, which the program starts and the file does not call."""

import rclpy
from std_msgs.msg import Int32


def main():
    rclpy.init()
    node = rclpy.create_node("entry")
    out = node.create_publisher(Int32, "out", 10)
    number = 5

    def on(msg):
        nonlocal number
        number = 1

    def tick():
        out.publish(Int32(data=number))

    node.create_subscription(Int32, "cmd", on, 10)
    node.create_timer(1.0, tick)
    rclpy.spin(node)
