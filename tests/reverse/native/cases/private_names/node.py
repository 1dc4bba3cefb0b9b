#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class Base(object):
    def __init__(self):
        self.__x = 1

    def set(self):
        self.__x = 5


class N(Base):
    def __init__(self):
        Base.__init__(self)
        self.__x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)

    def cb(self, m):
        self.set()
        self.pub.publish(self.__x)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
