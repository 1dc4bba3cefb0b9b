#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class A(object):
    def set(self):
        self.x = 1


class B(A):
    def set(self):
        super(B, self).set()
        self.x += 2


class C(A):
    def set(self):
        super(C, self).set()
        self.x *= 10


class N(B, C):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)

    def cb(self, m):
        self.set()
        self.pub.publish(self.x)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
