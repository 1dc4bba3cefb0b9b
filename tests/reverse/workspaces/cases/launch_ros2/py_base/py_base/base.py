from rclpy.node import Node
from std_msgs.msg import Int32


class Base(Node):
    def __init__(self, name):
        super().__init__(name)
        self.count = 0
        self.pub = self.create_publisher(Int32, "alarm", 10)

    def send(self, value):
        m = Int32()
        m.data = value
        self.pub.publish(m)


class Unused(Node):
    def __init__(self):
        super().__init__("unused")
        self.pub = self.create_publisher(Int32, "level", 10)
        self.create_subscription(Int32, "alarm", self.cb, 10)

    def cb(self, msg):
        self.pub.publish(msg)
