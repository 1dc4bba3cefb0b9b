#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class N(Node):
    count = 0

    def __init__(self):
        super().__init__("n")
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        N.count += 1
        self.pub.publish(Int32(data=self.count))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
