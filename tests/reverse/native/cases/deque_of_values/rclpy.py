#!/usr/bin/env python3
from collections import deque

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.seen = deque(maxlen=2)
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        self.seen.append(m.data)
        if len(self.seen) == 2:
            self.put(self.seen[0])

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
