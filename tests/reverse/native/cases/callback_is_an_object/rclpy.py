#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Add:
    def __init__(self, node):
        self.node = node

    def __call__(self, m):
        self.node.put(m.data + 3)


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", Add(self), 9)

    def cb(self, m):
        self.put(m.data)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
