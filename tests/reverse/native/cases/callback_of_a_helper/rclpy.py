#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Helper:
    def __init__(self, node):
        self.node = node
        self.count = 7

    def on_message(self, m):
        self.count += m.data
        self.node.put(self.count)


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        self.helper = Helper(self)
        self.create_subscription(Int32, "inp", self.helper.on_message, 9)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
