import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool, Int32


class Door(Node):
    """Opens in a second, and tells how often it did."""

    def __init__(self):
        super().__init__("door")
        self.opened = 0
        self.pub = self.create_publisher(Int32, "opened", 10)
        self.create_subscription(Bool, "open", self.open, 10)

    def open(self, msg):
        if msg.data:
            time.sleep(1.0)
            self.opened += 1
            out = Int32()
            out.data = self.opened
            self.pub.publish(out)


def main():
    rclpy.init()
    rclpy.spin(Door())
    rclpy.shutdown()


if __name__ == "__main__":
    main()
