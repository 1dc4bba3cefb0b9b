import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Bool, Int32

KEPT = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Lamp(Node):
    def __init__(self):
        super().__init__("lamp")
        self.light = self.create_publisher(Int32, "/light", 10)
        self.create_subscription(Bool, "/on", self.switched, KEPT)

    def switched(self, msg):
        self.light.publish(Int32(data=100 if msg.data else 0))


def main():
    rclpy.init()
    rclpy.spin(Lamp())


if __name__ == "__main__":
    main()
