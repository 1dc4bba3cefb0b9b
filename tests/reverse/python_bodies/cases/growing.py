"""Loops that change nothing of the model, and may not end."""

import rospy
from std_msgs.msg import Int32


class Log:
    def __init__(self):
        self.log = [1.5, 2.5]
        self.table = {}
        self.count = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("a", Int32, self.on_a)
        rospy.Subscriber("b", Int32, self.on_b)
        rospy.Subscriber("c", Int32, self.on_c)
        rospy.Subscriber("d", Int32, self.on_d)

    def on_a(self, msg):
        for x in self.log:
            self.log.append(x)
        self.count = 1
        self.pub.publish(Int32(1))

    def on_b(self, msg):
        for x in self.log:
            self.table[x] = 1
        self.count = 2

    def on_c(self, msg):
        for k in self.table:
            self.table[k + 1] = 1
        self.count = 2

    def on_d(self, msg):
        for k, v in self.table.items():
            rospy.loginfo("%s", k)
        for k in sorted(self.table):
            y = self.table[k] + 1
        self.count = 2


if __name__ == "__main__":
    rospy.init_node("n")
    Log()
    rospy.spin()
