#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class N(object):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)
        self.s = "abc"

    def cb(self, m):
        if self.s[1] == "b":
            self.pub.publish(1)
        else:
            self.pub.publish(2)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
