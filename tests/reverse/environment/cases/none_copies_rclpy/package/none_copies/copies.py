"""Copies what may be no message yet: the copy is None where that was None."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Copies(Node):
    def __init__(self):
        super().__init__("copies")
        self.last = None
        self.older = None
        self.tested = self.create_publisher(Int32, "tested", 10)
        self.chosen = self.create_publisher(Int32, "chosen", 10)
        self.returned = self.create_publisher(Int32, "returned", 10)
        self.second = self.create_publisher(Int32, "second", 10)
        self.create_subscription(Int32, "cmd", self.on_cmd, 10)

    def on_cmd(self, msg):
        last = self.last
        again = self.before()
        self.older = self.last
        self.last = msg
        if last is None:
            self.tested.publish(Int32(data=2))
        elif last.data > 3:
            self.tested.publish(Int32(data=1))
        chosen = Int32()
        chosen.data = 1 if last else 2
        self.chosen.publish(chosen)
        copy = again
        if not copy:
            self.returned.publish(Int32(data=2))
        second = Int32()
        second.data = 1 if self.older is not None else 2
        self.second.publish(second)

    def before(self):
        return self.last


def main():
    rclpy.init()
    rclpy.spin(Copies())
    rclpy.shutdown()


if __name__ == "__main__":
    main()
