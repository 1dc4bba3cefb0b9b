#!/usr/bin/env python3
"""What `declare_parameter` gives is the value that the node starts with."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Declared(Node):
    def __init__(self):
        super().__init__("declared")
        self.limit = self.declare_parameter("limit", 3).value
        self.stamped = self.declare_parameter("stamped", True).value
        self.rate = self.declare_parameter("rate").value
        self.count = 0
        self.create_subscription(Int32, "in", self.heard, 10)

    def heard(self, message):
        if self.stamped and message.data < self.limit:
            self.count = message.data
        if self.rate:
            self.count = 0


def main():
    rclpy.init()
    rclpy.spin(Declared())


main()
