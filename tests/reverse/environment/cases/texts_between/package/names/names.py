"""Two nodes: what one says of a number is a text that nobody knows."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32, String


class Sayer(Node):
    def __init__(self):
        super().__init__("sayer")
        self.pub = self.create_publisher(String, "name", 1)
        self.create_subscription(Int32, "number", self.cb, 1)

    def cb(self, msg):
        self.pub.publish(String(data=f"x{msg.data}"))


class Hearer(Node):
    def __init__(self):
        super().__init__("hearer")
        self.pub = self.create_publisher(Int32, "level", 1)
        self.create_subscription(String, "name", self.cb, 1)

    def cb(self, msg):
        if msg.data == "go":
            self.pub.publish(Int32(data=1))


def say():
    rclpy.init()
    rclpy.spin(Sayer())


def hear():
    rclpy.init()
    rclpy.spin(Hearer())
