#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class N(object):
    x = 0

    def __init__(self):
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)

    def cb(self, m):
        self.x = 4
        self.pub.publish(N.x)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
