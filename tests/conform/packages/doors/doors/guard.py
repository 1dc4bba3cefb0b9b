import random

import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool


class Guard(Node):
    """Every four seconds it tells the door to open, or not."""

    def __init__(self):
        super().__init__("guard")
        self.pub = self.create_publisher(Bool, "open", 10)
        self.create_timer(4.0, self.decide)

    def decide(self):
        out = Bool()
        out.data = random.choice([True, False])
        self.pub.publish(out)


def main():
    rclpy.init()
    rclpy.spin(Guard())
    rclpy.shutdown()


if __name__ == "__main__":
    main()
