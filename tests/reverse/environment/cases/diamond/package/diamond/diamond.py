import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Base:
    def value(self):
        return 1


class Left(Base):
    pass


class Right(Base):
    def value(self):
        return 5


class Both(Left, Right, Node):
    def __init__(self):
        super().__init__("both")
        self._out = self.create_publisher(Int32, "out", 10)
        self.create_subscription(Int32, "go", self._on, 10)

    def _on(self, message):
        self._out.publish(Int32(data=self.value()))


def main():
    rclpy.init()
    rclpy.spin(Both())
    rclpy.shutdown()


if __name__ == "__main__":
    main()
