#!/usr/bin/env python3
# What is stored in by other ways than the name of a variable.
import collections

import rospy
from std_msgs.msg import Int32


class Gate:
    def __init__(self):
        self.count = 0
        self.level = 0
        self.table = {}
        self.rows = collections.deque(maxlen=3)
        rospy.Subscriber("first", Int32, self.on_first)
        rospy.Subscriber("other", Int32, self.on_other)
        rospy.Subscriber("plain", Int32, self.on_plain)

    def hit(self):
        self.count += 1
        return 1

    def itself(self):
        return self

    def on_first(self, msg):
        (self).count = 3
        [self][0].count = 3
        (self if msg.data else None).count = 3
        self.itself().count = 3
        self.itself().count += 3
        (self).count, rest = 1, 2
        vars(self)["count"] = 3
        del vars(self)["count"]
        globals()["gate"] = None

    def on_other(self, msg):
        self.table[self.hit()] = 3
        self.table[self.hit()].size = 3
        del self.table[self.hit()]
        for self.level in range(3):
            pass
        numbers = [0 for self.count in range(3)]
        self.hit.__call__()
        del self.count

    def on_plain(self, msg):
        self.table["a"] = 3
        self.table["a"]["b"] = 3
        self.rows[len(self.rows) - 1] = rospy.Time.now()
        del self.table["a"]
        one, *others = "a b c".split()
        pairs = [a + b for a, b in zip([1], [2])]
        for a, (b, c) in zip([1], [(2, 3)]):
            rospy.loginfo("%s", a)


def clear(gate):
    gate.level = 5
    gate.note = "cleared"


if __name__ == "__main__":
    rospy.init_node("gate")
    gate = Gate()
    clear(gate)
    rospy.spin()
