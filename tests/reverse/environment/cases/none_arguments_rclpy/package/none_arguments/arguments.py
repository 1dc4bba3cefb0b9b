"""Gives the message that it keeps to a function that replaces it: the argument stays what it was."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Arguments(Node):
    def __init__(self):
        super().__init__("arguments")
        self.last = None
        self.out = self.create_publisher(Int32, "out", 10)
        self.create_subscription(Int32, "cmd", self.on_cmd, 10)
        self.create_subscription(Int32, "other", self.on_other, 10)

    def on_other(self, msg):
        self.last = msg

    def on_cmd(self, msg):
        self.exchange(self.last, msg)

    def exchange(self, before, msg):
        self.last = msg
        if before is None:
            self.out.publish(Int32(data=2))
        else:
            self.out.publish(Int32(data=1))


def main():
    rclpy.init()
    rclpy.spin(Arguments())
    rclpy.shutdown()


if __name__ == "__main__":
    main()
