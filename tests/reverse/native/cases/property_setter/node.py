#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class N(object):
    def __init__(self):
        self._x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)

    @property
    def x(self):
        return self._x

    @x.setter
    def x(self, v):
        self._x = v * 2

    def cb(self, m):
        self.x = 4
        self.pub.publish(self._x)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
