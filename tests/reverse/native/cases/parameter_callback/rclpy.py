#!/usr/bin/env python3
import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import Int32


class N(Node):
    def __init__(self):
        super().__init__("n")
        self.x = 0
        self.pub = self.create_publisher(Int32, "out", 9)
        self.create_subscription(Int32, "inp", self.cb, 9)
        self.declare_parameter("gain", 3)
        self.add_on_set_parameters_callback(self.changed)

    def changed(self, parameters):
        for p in parameters:
            if p.name == "gain":
                self.x = p.value
        return SetParametersResult(successful=True)

    def cb(self, m):
        self.set_parameters([Parameter("gain", Parameter.Type.INTEGER, 8)])
        self.put(self.x)

    def put(self, value):
        self.pub.publish(Int32(data=value))


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(N())
