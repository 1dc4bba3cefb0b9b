"""Charges in the mode that is asked for; the modes are constants of a message of the package."""

import rclpy
from modes.msg import Mode
from rclpy.node import Node
from std_msgs.msg import Bool, Int32

IDLE, CHARGING = range(2)


class Charger(Node):
    def __init__(self):
        super().__init__("charger")
        self.mode = Mode.OFF
        self.state = IDLE
        self.outputs = {}
        self.outputs["current"] = self.create_publisher(Int32, "current", 10)
        self.outputs["busy"] = self.create_publisher(Bool, "busy", 10)
        self.create_subscription(Mode, "mode_request", self.on_request, 10)

    def on_request(self, msg):
        if msg.mode not in (Mode.OFF, Mode.SLOW, Mode.FAST):
            return
        self.mode = msg.mode
        self.state = IDLE if msg.mode == msg.OFF else CHARGING
        self.outputs["current"].publish(Int32(data=4 if self.mode == Mode.FAST else self.mode))
        self.outputs["busy"].publish(Bool(data=self.state == CHARGING))


def main():
    rclpy.init()
    rclpy.spin(Charger())
