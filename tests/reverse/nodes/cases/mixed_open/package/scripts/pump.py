#!/usr/bin/env python3
import random

import rclpy
from geometry_msgs.msg import Point
from rclpy.node import Node
from std_msgs.msg import Int32


class Pump(Node):
    def __init__(self):
        super().__init__("keeper")
        self.flowing = False
        self.pub = self.create_publisher(Int32, "valve", 3)
        self.sub = self.create_subscription(Point, "flow", self.on_flow, 3)
        self.low = self.create_subscription(Point, "flow", self.on_height, 3)
        self.timer = self.create_timer(1.0, self.tick)

    def on_flow(self, msg):
        self.flowing = msg.x > 1.0

    def on_height(self, msg):
        if msg.z > 1.0:
            self.pub.publish(Int32(data=0))

    def tick(self):
        if self.flowing:
            self.pub.publish(Int32(data=random.randint(0, 2)))
        else:
            self.pub.publish(Int32(data=int(random.gauss(1.0, 2.0))))


def main():
    rclpy.init()
    rclpy.spin(Pump())


if __name__ == "__main__":
    main()
