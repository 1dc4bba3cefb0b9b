#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class C(object):
    seen = [0]

    def inc(self):
        self.seen[0] += 1
        return self.seen[0]


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
