import queue

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Worker(Node):
    def __init__(self):
        super().__init__("worker")
        self._jobs = queue.Queue()
        self._out = self.create_publisher(Int32, "out", 10)
        self.create_subscription(Int32, "go", self._on, 10)

    def _on(self, message):
        self._jobs.get()
        self._out.publish(Int32(data=1))


def main():
    rclpy.init()
    rclpy.spin(Worker())
    rclpy.shutdown()


if __name__ == "__main__":
    main()
