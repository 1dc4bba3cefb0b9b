#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Base(Node):
    def __init__(self):
        super().__init__("n")
        self.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        self.put(self.value())

    def value(self):
        return 1


class N(Base):
    def __init__(self):
        super().__init__()
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)

    def value(self):
        return 5

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
