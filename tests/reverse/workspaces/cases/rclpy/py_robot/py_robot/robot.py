import rclpy
from py_base.base import Base
from ws_msgs.msg import Level


class Robot(Base):
    def __init__(self):
        super().__init__("robot")
        self.create_subscription(Level, "level", self.cb, 10)

    def cb(self, msg):
        if msg.level > Level.MAX and msg.hot:
            self.count = 1
            self.send(1)


def main():
    rclpy.init()
    rclpy.spin(Robot())
    rclpy.shutdown()
