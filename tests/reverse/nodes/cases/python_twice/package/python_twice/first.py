import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Source(Node):
    def __init__(self):
        super().__init__("source")
        self.count = 0
        self.pub = self.create_publisher(Int32, "numbers", 2)
        self.sub = self.create_subscription(Int32, "done", self.done, 2)
        self.timer = self.create_timer(1.0, self.tick)

    def tick(self):
        self.pub.publish(Int32(data=self.count))

    def done(self, msg):
        self.count = 0 if msg.data > 3 else msg.data + 1


def main():
    rclpy.init()
    rclpy.spin(Source())
