#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class C(object):
    def __init__(self):
        self.k = 0

    def inc(self):
        if self.k < 5:
            self.k += 1
        return self.k


class N(object):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)
        self.a = C()
        self.b = C()

    def cb(self, m):
        self.a.inc()
        self.pub.publish(self.b.inc())


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
