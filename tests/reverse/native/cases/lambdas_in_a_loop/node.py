#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class N(object):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        for i in range(3):
            rospy.Subscriber("in%d" % i, Int32, lambda m: self.cb(i))

    def cb(self, i):
        self.pub.publish(i)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
