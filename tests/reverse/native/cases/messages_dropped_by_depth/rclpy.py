#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        self.own = self.create_publisher(Int32, "own", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)
        self.create_subscription(Int32, "own", self.on_own, 1)

    def cb(self, m):
        for k in range(3):
            self.own.publish(Int32(data=k))

    def on_own(self, m):
        self.x = self.x * 2 + 2
        self.pub.publish(Int32(data=self.x + m.data))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
