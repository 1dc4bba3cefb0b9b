import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Loud:
    LIMIT = 5

    def value(self):
        return self.LIMIT


class Quiet(Node):
    LIMIT = 1

    def __init__(self):
        super().__init__("quiet")
        self._out = self.create_publisher(Int32, "out", 10)
        self.create_subscription(Int32, "go", self._on, 10)

    def value(self):
        return self.LIMIT

    def _on(self, message):
        self._out.publish(Int32(data=self.value()))


class Both(Loud, Quiet):
    pass


def main():
    rclpy.init()
    rclpy.spin(Both())
    rclpy.shutdown()


if __name__ == "__main__":
    main()
