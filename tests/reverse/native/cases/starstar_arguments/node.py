#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class N(object):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)

    def put(self, a=0, b=2):
        self.x = a - b

    def cb(self, m):
        v = {"a": 3, "b": 1}
        self.put(**v)
        self.pub.publish(self.x)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
