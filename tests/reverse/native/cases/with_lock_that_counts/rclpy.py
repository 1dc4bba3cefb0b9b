#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Counting:
    def __init__(self, node):
        self.node = node

    def __enter__(self):
        self.node.x += 1

    def __exit__(self, *_):
        self.node.x += 1


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)
        self.lock = Counting(self)

    def cb(self, m):
        with self.lock:
            self.put(self.x)
        self.put(self.x)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
