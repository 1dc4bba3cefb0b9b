#!/usr/bin/env python3
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32


class N(Node):
    def __init__(self, name, k):
        super().__init__(name)
        self.k = k
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        self.k += m.data
        self.pub.publish(Int32(data=self.k))


if __name__ == "__main__":
    rclpy.init()
    executor = SingleThreadedExecutor()
    for name, k in (("n", 1), ("m", 11)):
        executor.add_node(N(name, k))
    executor.spin()
