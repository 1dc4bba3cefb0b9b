#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class Block(object):
    def __init__(self, n):
        self.n = n

    def __enter__(self):
        self.n.x = 5

    def __exit__(self, *a):
        self.n.x = 7


class N(object):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)
        self.block = Block(self)

    def cb(self, m):
        with self.block:
            pass
        self.pub.publish(self.x)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
