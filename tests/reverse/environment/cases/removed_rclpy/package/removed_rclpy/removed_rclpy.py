import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32
from rclpy.executors import SingleThreadedExecutor


class Gone(Node):
    def __init__(self):
        super().__init__("gone")
        self._out = self.create_publisher(Int32, "out", 10)
        self.create_subscription(Int32, "go", self._on, 10)

    def _on(self, message):
        self._out.publish(Int32(data=1))


def main():
    rclpy.init()
    node = Gone()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.remove_node(node)
    executor.spin()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
