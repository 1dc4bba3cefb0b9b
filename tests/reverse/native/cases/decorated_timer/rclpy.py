#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


def every(n):
    def decorate(function):
        def wrapped(self):
            self.calls += 1
            if self.calls % n == 0:
                function(self)

        return wrapped

    return decorate


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.calls = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_timer(1.0, self.tick)

    @every(3)
    def tick(self):
        self.put(self.calls)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
