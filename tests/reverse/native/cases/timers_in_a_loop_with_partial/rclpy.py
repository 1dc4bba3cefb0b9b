#!/usr/bin/env python3
from functools import partial

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        self.kept = [self.create_timer(1.0 + k, partial(self.tick, k)) for k in range(3)]

    def tick(self, k):
        self.x += k
        self.put(20 + k)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
