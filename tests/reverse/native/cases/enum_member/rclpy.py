#!/usr/bin/env python3
from enum import Enum

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Mode(Enum):
    IDLE = 1
    BUSY = 2


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.mode = Mode.IDLE
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        self.mode = Mode(self.mode.value + 1)
        self.put(self.mode.value)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
