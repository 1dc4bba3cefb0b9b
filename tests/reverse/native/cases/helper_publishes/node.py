#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class Helper(object):
    def __init__(self):
        self.pub = rospy.Publisher("out", Int32, queue_size=1)

    def go(self):
        self.pub.publish(5)


class N(object):
    def __init__(self):
        self.x = 0
        self.helper = Helper()
        rospy.Subscriber("inp", Int32, self.cb)

    def cb(self, m):
        self.helper.go()


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
