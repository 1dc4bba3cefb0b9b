"""Texts with which more is done than to copy and to compare them."""

from enum import Enum

import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool, String

TABLE = {"go": 0}


class Mode(Enum):
    STOP = "stop"


class Changes(Node):
    def __init__(self):
        super().__init__("changes")
        self.last = ""
        self.mode = "go"
        self.name = "sto"
        self.known = {"go": 0}
        self.others = self.create_publisher(Bool, "others", 1)
        self.lowered = self.create_publisher(Bool, "lowered", 1)
        self.appended = self.create_publisher(Bool, "appended", 1)
        self.grown = self.create_publisher(Bool, "grown", 1)
        self.renamed = self.create_publisher(Bool, "renamed", 1)
        self.within = self.create_publisher(Bool, "within", 1)
        self.number = self.create_publisher(Bool, "number", 1)
        self.create_subscription(String, "command", self.on_command, 1)

    def on_command(self, message):
        if message.data != "a" and self.last != "a" and message.data != self.last:
            self.others.publish(Bool(data=True))
        self.mode = message.data.lower()
        if self.mode == "stop":
            self.lowered.publish(Bool(data=True))
        self.name += "p"
        if self.name == "stop":
            self.appended.publish(Bool(data=True))
        self.known["stop"] = 1
        if message.data in self.known and message.data == "stop":
            self.grown.publish(Bool(data=True))
        names = TABLE
        names["stop"] = 1
        if TABLE.get(message.data, 0) == 1:
            self.renamed.publish(Bool(data=True))
        if "top" in message.data:
            self.within.publish(Bool(data=True))
        if message.data == Mode.STOP or message.data > "a":
            self.number.publish(Bool(data=True))
        self.last = message.data


def main():
    rclpy.init()
    rclpy.spin(Changes())


if __name__ == "__main__":
    main()
