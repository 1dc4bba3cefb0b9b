#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        chosen = {"a": self.one, "b": self.two}
        self.create_subscription(Int32, "inp", chosen["b"], 9)

    def one(self, m):
        self.put(1)

    def two(self, m):
        self.put(2)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
