#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class N(object):
    def __init__(self):
        self.x = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)

    def run(self):
        r = rospy.Rate(1)
        while not rospy.is_shutdown():
            if self.x == 2:
                break
            self.x += 1
            r.sleep()
        self.pub.publish(50)


if __name__ == "__main__":
    rospy.init_node("n")
    N().run()
