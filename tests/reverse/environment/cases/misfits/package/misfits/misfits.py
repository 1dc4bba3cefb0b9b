import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32
from rclpy.qos import QoSProfile, ReliabilityPolicy


class Relay(Node):
    def __init__(self):
        super().__init__("relay")
        lossy = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        sure = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)
        self._middle = self.create_publisher(Int32, "middle", lossy)
        self._out = self.create_publisher(Int32, "out", 10)
        self.create_subscription(Int32, "go", self._on_go, 10)
        self.create_subscription(Int32, "middle", self._on_middle, sure)

    def _on_go(self, message):
        self._middle.publish(Int32(data=1))

    def _on_middle(self, message):
        self._out.publish(Int32(data=1))


def main():
    rclpy.init()
    rclpy.spin(Relay())
    rclpy.shutdown()


if __name__ == "__main__":
    main()
