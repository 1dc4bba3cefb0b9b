#!/usr/bin/env python3
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Int32
from std_srvs.srv import SetBool


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        group = ReentrantCallbackGroup()
        self.create_subscription(Int32, "inp", self.cb, 9, callback_group=group)
        self.create_service(SetBool, "switch", self.serve)
        self.client = self.create_client(SetBool, "switch", callback_group=group)

    def serve(self, request, response):
        self.x += 30
        response.success = self.x > 30
        return response

    async def cb(self, m):
        self.x = 1
        result = await self.client.call_async(SetBool.Request(data=True))
        if result.success:
            self.put(self.x)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
