import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Bool

KEPT = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Switch(Node):
    def __init__(self):
        super().__init__("switch")
        self.on = False
        self.pub = self.create_publisher(Bool, "/on", KEPT)
        self.create_subscription(Bool, "/press", self.press, 10)
        self.pub.publish(Bool(data=self.on))

    def press(self, msg):
        self.on = not self.on
        self.pub.publish(Bool(data=self.on))


def main():
    rclpy.init()
    rclpy.spin(Switch())


if __name__ == "__main__":
    main()
