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
        self.pub = self.create_publisher(Int32, "out", 9)
        group = ReentrantCallbackGroup()
        self.create_subscription(Int32, "inp", self.cb, 9, callback_group=group)

    def cb(self, m):
        self.x = m.data
        time.sleep(3)
        self.put(self.x)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    node = N()
    executor = MultiThreadedExecutor()
    executor.add_node(node)
    executor.spin()
