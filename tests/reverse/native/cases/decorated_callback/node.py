#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


def twice(f):
    def g(self, m):
        f(self, m)
        f(self, m)

    return g


class N(object):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)

    @twice
    def cb(self, m):
        if self.x < 9:
            self.x += 1
        self.pub.publish(self.x)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
