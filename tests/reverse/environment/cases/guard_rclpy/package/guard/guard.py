"""Drives on until the bumper was pressed three times."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Bool


class Guard(Node):
    def __init__(self):
        super().__init__("guard")
        self.hits = 0
        self.pressed = False
        self.command = self.create_publisher(Twist, "cmd_vel", 1)
        self.stopped = self.create_publisher(Bool, "stopped", 1)
        self.create_subscription(Bool, "bumper", self.on_bumper, 1)
        self.create_timer(0.1, self.drive)

    def on_bumper(self, message):
        self.pressed = message.data
        if message.data and self.hits < 3:
            self.hits += 1
            if self.hits == 3:
                self.stopped.publish(Bool(data=True))

    def drive(self):
        command = Twist()
        if self.hits < 3 and not self.pressed:
            command.linear.x = 0.5
        elif self.hits < 3:
            command.angular.z = 1.0
        self.command.publish(command)


def main():
    rclpy.init()
    rclpy.spin(Guard())


if __name__ == "__main__":
    main()
