#!/usr/bin/env python3
import rospy
from py_base.base import Base
from ws_msgs.msg import Level


class Robot(Base):
    def __init__(self):
        super().__init__()
        rospy.Subscriber("level", Level, self.cb)

    def cb(self, msg):
        if msg.level > Level.MAX and msg.hot:
            self.count = 1
            self.send(1)


if __name__ == "__main__":
    rospy.init_node("robot")
    Robot()
    rospy.spin()
