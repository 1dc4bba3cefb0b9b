#!/usr/bin/env python3
from contextlib import contextmanager

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        with self.held():
            self.x += 4
        self.put(self.x)

    @contextmanager
    def held(self):
        self.x = 2
        yield
        self.x += 3

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
