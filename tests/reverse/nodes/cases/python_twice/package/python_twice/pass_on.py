import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Relay(Node):
    def __init__(self):
        super().__init__("relay")
        self.declare_parameter("most", 5)
        self.most = self.get_parameter("most").value
        self.pub = self.create_publisher(Int32, "out", 2)
        self.sub = self.create_subscription(Int32, "in", self.received, 2)

    def received(self, msg):
        if msg.data < self.most:
            self.pub.publish(Int32(data=msg.data))


def main():
    rclpy.init()
    rclpy.spin(Relay())
