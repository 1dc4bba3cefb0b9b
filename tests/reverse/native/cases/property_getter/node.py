#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class N(object):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)
        self.k = 3

    @property
    def y(self):
        self.k = 6
        return self.x

    def cb(self, m):
        if self.y == 0:
            self.pub.publish(self.k)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
