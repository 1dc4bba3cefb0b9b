import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Bool


class Aliases(Node):
    def __init__(self):
        super().__init__("aliases")
        self.one = Twist()
        self.all = [self.one]
        self.command = self.create_publisher(Twist, "cmd_vel", 1)
        self.create_subscription(Bool, "go", self.on_go, 1)
        self.create_subscription(Bool, "all", self.on_all, 1)
        self.create_subscription(Bool, "made", self.on_made, 1)

    def get(self):
        return self.one

    def on_go(self, message):
        other = self.one
        other.linear.x = 0.5
        self.command.publish(self.one)

    def on_all(self, message):
        for each in self.all:
            each.linear.y = 0.5
        self.command.publish(self.one)

    def on_made(self, message):
        self.get().linear.z = 0.5
        self.command.publish(self.one)


def main():
    rclpy.init()
    rclpy.spin(Aliases())
