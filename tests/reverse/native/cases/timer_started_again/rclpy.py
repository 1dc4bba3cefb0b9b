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
        self.timer = self.create_timer(0.25, self.tick)

    def tick(self):
        self.x += 1
        self.timer.cancel()
        if self.x > 1:
            self.put(9)

    def cb(self, m):
        self.timer.reset()

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
