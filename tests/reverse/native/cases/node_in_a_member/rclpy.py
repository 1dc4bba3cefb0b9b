#!/usr/bin/env python3
import rclpy
from std_msgs.msg import Int32


class N:
    def __init__(self):
        self.node = rclpy.create_node("n")
        self.x = 2
        self.pub = self.node.create_publisher(Int32, "out", 9)
        self.node.create_subscription(Int32, "inp", self.cb, 9)

    def cb(self, m):
        self.x += m.data
        self.pub.publish(Int32(data=self.x))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N().node)
