"""Goes by words."""

from enum import Enum

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32, String


class State(Enum):
    IDLE = "idle"
    RUNNING = "running"
    DONE = "done"


class Words(Node):
    def __init__(self):
        super().__init__("words")
        self.state = State.IDLE
        self.last = None
        self.level = self.create_publisher(Int32, "level", 1)
        self.status = self.create_publisher(String, "status", 1)
        self.create_subscription(String, "command", self.on_command, 1)

    def on_command(self, message):
        match message.data:
            case "":
                self.enter(State.IDLE, 3)
            case "start" | "go" if self.state is State.IDLE:
                self.enter(State.RUNNING, 1)
            case "finish" if self.state == State.RUNNING:
                self.enter(State.DONE, 2)
            case "reset":
                self.enter(State.IDLE, 0)
            case _:
                pass
        if self.state == "idle" or self.last is not None and not self.last:
            self.level.publish(Int32(data=9))
        self.last = "x"

    def enter(self, state, level):
        self.state = state
        self.level.publish(Int32(data=level))
        if state == State.RUNNING:
            self.status.publish(String(data=State.RUNNING.value))
        elif state == State.DONE:
            self.status.publish(String(data="done"))
        else:
            self.status.publish(String(data="idle"))


def main():
    rclpy.init()
    rclpy.spin(Words())


if __name__ == "__main__":
    main()
