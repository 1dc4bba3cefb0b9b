#!/usr/bin/env python3
from enum import IntEnum

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Mode(IntEnum):
    IDLE = 1
    BUSY = 2


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.mode = Mode.BUSY
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        self.put(self.mode + 3)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
