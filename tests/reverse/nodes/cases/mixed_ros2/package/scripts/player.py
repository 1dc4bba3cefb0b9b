#!/usr/bin/env python3
import rclpy
from geometry_msgs.msg import Point
from rclpy.node import Node
from std_msgs.msg import Int32


class Counter(Node):
    def __init__(self):
        super().__init__("player")
        self.declare_parameter("step", 1)
        self.step = self.get_parameter("step").value
        self.answer = 0
        self.pub = self.create_publisher(Int32, "answers", 10)
        self.sub = self.create_subscription(Point, "turn", self.on_turn, 10)

    def on_turn(self, msg):
        if msg.y < 100.0 and self.answer < 1000:
            self.answer = self.answer + self.step
            out = Int32()
            out.data = self.answer
            self.pub.publish(out)


def main():
    rclpy.init()
    rclpy.spin(Counter())


if __name__ == "__main__":
    main()
