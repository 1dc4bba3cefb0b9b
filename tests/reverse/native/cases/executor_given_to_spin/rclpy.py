#!/usr/bin/env python3
import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.busy = False
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)
        self.create_timer(1.0, self.tick, callback_group=ReentrantCallbackGroup())

    def cb(self, m):
        self.x = 1
        self.busy = True
        time.sleep(3.0)
        self.busy = False
        self.put(self.x)

    def tick(self):
        if self.busy:
            self.x = 3

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    from rclpy.executors import MultiThreadedExecutor as Threads

    executor = Threads(4)
    executor.add_node(N())
    executor.spin()
