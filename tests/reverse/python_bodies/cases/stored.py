#!/usr/bin/env python3
# What a callback stores in a class is no constant of that class any more.
import rospy
from std_msgs.msg import Int32


class Limits:
    LOW = 1
    HIGH = 4


class Gauge:
    def __init__(self):
        self.zone = 0
        rospy.Subscriber("level", Int32, self.level)
        rospy.Subscriber("limit", Int32, self.limit)

    def level(self, msg):
        if msg.data > Limits.HIGH:
            self.zone = 2
        elif msg.data > Limits.LOW:
            self.zone = 1

    def limit(self, msg):
        Limits.HIGH = msg.data


if __name__ == "__main__":
    rospy.init_node("gauge")
    Gauge()
    rospy.spin()
