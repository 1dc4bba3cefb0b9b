"""A door that says itself in which namespace its topics are."""
import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool


class Door(Node):
    def __init__(self):
        super().__init__('door', namespace='left')
        self.pub = self.create_publisher(Bool, 'open', 1)
        self.create_subscription(Bool, 'cmd', self.cb, 1)

    def cb(self, m):
        self.pub.publish(m)


def main():
    rclpy.init()
    rclpy.spin(Door())


if __name__ == '__main__':
    main()
