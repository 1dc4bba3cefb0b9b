"""Keeps a message under a second name and goes on changing it."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node


class Keeper(Node):
    def __init__(self):
        super().__init__("keeper")
        self.last = Twist()
        self.out = self.create_publisher(Twist, "out", 1)
        self.create_subscription(Twist, "command", self.on_command, 1)
        self.create_timer(1.0, self.tick)

    def on_command(self, msg):
        twist = Twist()
        for number in range(2):
            twist.linear.x = number * 9.0
            if number == 0:
                self.last = twist

    def tick(self):
        self.out.publish(self.last)


def main():
    rclpy.init()
    rclpy.spin(Keeper())
