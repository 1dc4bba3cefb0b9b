#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.future = Future()
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        if not self.future.done():
            self.future.set_result(m.data)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    node = N()
    rclpy.spin_until_future_complete(node, node.future)
    node.put(node.future.result() + 10)
