"""Says which of its values are True, False or None themselves."""
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Flags(Node):
    def __init__(self):
        super().__init__("flags")
        self.level = 0
        self.is_high = False
        self.number = self.create_publisher(Int32, "number", 10)
        self.truth = self.create_publisher(Int32, "truth", 10)
        self.create_subscription(Int32, "level", self.on_level, 10)

    def on_level(self, msg):
        self.level = msg.data
        self.is_high = msg.data > 3
        if self.level is True or self.level is None or True is msg.data:
            self.number.publish(Int32(data=1))
        elif self.level == True and self.level is not False and self.level != None:
            self.number.publish(Int32(data=2))
        if self.is_high is True:
            self.truth.publish(Int32(data=1))
        elif self.is_high is False and self.is_high is not None:
            self.truth.publish(Int32(data=2))
        else:
            self.truth.publish(Int32(data=3))


def main():
    rclpy.init()
    rclpy.spin(Flags())


if __name__ == "__main__":
    main()
