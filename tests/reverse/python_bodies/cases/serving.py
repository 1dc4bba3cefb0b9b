#!/usr/bin/env python3
"""A node that serves one callback after the other in a loop of its own, as `spin` does."""

import sys

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Counter(Node):
    def __init__(self):
        super().__init__("counter")
        self.count = 0
        self.timer = self.create_timer(2.0, self.tick)
        self.pub = self.create_publisher(Int32, "count", 10)

    def tick(self):
        self.count = (self.count + 1) % 3
        message = Int32()
        message.data = self.count
        self.pub.publish(message)


def main(args=None):
    rclpy.init(args=args)
    node = Counter()
    while rclpy.ok():
        node.get_logger().debug("the next one")
        rclpy.spin_once(node, timeout_sec=1.0)
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    sys.exit(main())
