#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.pubs = {}
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)
        for name in ("out", "log"):
            self.pubs[name] = self.create_publisher(Int32, name, 9)

    def cb(self, m):
        self.pubs["out"].publish(Int32(data=3))
        self.pubs["log"].publish(Int32(data=4))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
