#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class V(object):
    def __init__(self, n):
        self.n = n

    def __eq__(self, o):
        self.n.x = 5
        return True


class N(object):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)
        self.v = V(self)

    def cb(self, m):
        if self.v == 1:
            self.pub.publish(self.x)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
