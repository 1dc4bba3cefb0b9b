#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


def doubled(f):
    def g(m):
        f(m)
        pub.publish(6)

    return g


@doubled
def cb(m):
    pub.publish(1)


if __name__ == "__main__":
    rospy.init_node("n")
    pub = rospy.Publisher("out", Int32, queue_size=1)
    rospy.Subscriber("inp", Int32, cb)
    rospy.spin()
