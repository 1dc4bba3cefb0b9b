#!/usr/bin/env python3
# What the model cannot have as it is: each place is listed.
import time

import rospy
from std_msgs.msg import Bool, Int16, Int32

total = 0


class Meter:
    def __init__(self):
        self.level = 0
        self.names = []
        self.pub = rospy.Publisher("level", Int16, queue_size=2)
        rospy.Subscriber("add", Int32, self.add)
        rospy.Subscriber("stop", Bool, self.stop)

    def add(self, msg):
        global total
        total = total + 1 if total < 5 else 0
        self.level = self.level + msg.data
        self.names.append(str(msg.data))
        if self.level > 10 and len(self.names) > 3:
            self.pub.publish(msg.data)
        half = msg.data / 2
        if half > 1.5:
            self.pub.publish(Int16(msg.data % 100))
        try:
            self.pub.publish(int(self.names[0]))
        except ValueError:
            rospy.logwarn("no number")

    def stop(self, msg):
        if not msg.data:
            raise RuntimeError("stopped")
        for name in self.names:
            print(name)
        x = 7 // msg.data
        time.sleep(0.3)


def clear(meter):
    meter.level = 0


def watch(msg):
    global total
    total = 0
    rospy.signal_shutdown("done")


if __name__ == "__main__":
    rospy.init_node("meter")
    meter = Meter()
    rospy.Subscriber("watch", Int32, watch)
    clear(meter)
    rospy.spin()
