#!/usr/bin/env python3
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
        msg = Int32(data=1)
        self.pub.publish(msg)
        msg.data = 9


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
