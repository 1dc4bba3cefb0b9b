#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32
from std_srvs.srv import SetBool


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)
        self.create_service(SetBool, "switch", self.serve)
        self.client = self.create_client(SetBool, "switch")

    def serve(self, request, response):
        self.x = 30 if request.data else 40
        response.success = True
        return response

    def cb(self, m):
        future = self.client.call_async(SetBool.Request(data=True))
        future.add_done_callback(self.answered)

    def answered(self, future):
        if future.result().success:
            self.put(self.x)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
