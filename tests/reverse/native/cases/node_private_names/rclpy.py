#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Base(Node):
    def __init__(self):
        super().__init__("n")
        self.__x = 0

    def set(self):
        self.__x = 5


class N(Base):
    def __init__(self):
        super().__init__()
        self.__x = 1
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        self.set()
        self.put(self.__x)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
