#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32

LIMITS = (2, 5, 9)


class N(object):
    def __init__(self):
        self.a = 0
        self.zero = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("inp", Int32, self.cb)

    def cb(self, m):
        self.a = m.data if 0 <= m.data <= 40 else 3
        n = sum(limit for limit in LIMITS if limit > self.a)
        n += 100 * min(LIMITS, key=lambda limit: abs(limit - self.a))
        n += 1000 * max(self.a, 2, 3)
        if self.a not in (1, 2) and self.a in range(2, 6):
            n += 10000
        if any(self.a == place * 2 for place, _ in enumerate(LIMITS, 1)):
            n += 20000
        n += 100000 * {4: 1, 5: 2}.get(self.a, 0)
        n += 1000000 * (self.zero or self.a)
        self.pub.publish(n)


if __name__ == "__main__":
    rospy.init_node("n")
    N()
    rospy.spin()
