#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class N(object):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=9)
        rospy.Subscriber("inp", Int32, self.cb)

    def cb(self, m):
        other = m
        other.data = 9
        self.pub.publish(m.data)

if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
