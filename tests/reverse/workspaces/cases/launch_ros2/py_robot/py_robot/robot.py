import rclpy
from py_base.base import Base
from ws_msgs.msg import Level


class Robot(Base):
    def __init__(self):
        super().__init__("robot")
        self.limit = self.declare_parameter("limit", 7).value
        self.create_subscription(Level, "level", self.cb, 10)

    def cb(self, msg):
        if msg.level > self.limit:
            self.send(self.limit)


def main():
    rclpy.init()
    rclpy.spin(Robot())
    rclpy.shutdown()
