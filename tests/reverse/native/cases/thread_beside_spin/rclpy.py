#!/usr/bin/env python3
import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)
        worker = threading.Thread(target=self.work)
        worker.start()
        worker.join()

    def cb(self, m):
        self.put(self.x)

    def work(self):
        self.x = 9

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
