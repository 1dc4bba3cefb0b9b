#!/usr/bin/env python3
from dataclasses import dataclass

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


@dataclass
class State:
    count: int = 2

    def __post_init__(self):
        self.count *= 4


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.state = State()
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        self.put(self.state.count)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
