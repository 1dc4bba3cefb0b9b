#!/usr/bin/env python3
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.future = Future()
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9, callback_group=ReentrantCallbackGroup())

    async def cb(self, m):
        if m.data == 1:
            self.x = 1
            await self.future
            self.put(self.x)
        else:
            self.x = 7
            self.future.set_result(None)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
