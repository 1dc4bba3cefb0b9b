#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


LIMIT = 3


class N(object):
    def __init__(self, limit=LIMIT):
        self.x = limit
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)

    def cb(self, m):
        self.pub.publish(self.x)


LIMIT = 8


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
