#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32


class Idioms:
    def __init__(self):
        self.near, self.far = 1, 2
        self.swapped = rospy.Publisher("swapped", Int32, queue_size=10)
        self.count = rospy.Publisher("count", Int32, queue_size=10)
        self.found = rospy.Publisher("found", Int32, queue_size=10)
        self.kind = rospy.Publisher("kind", Int32, queue_size=10)
        self.level = rospy.Publisher("level", Int32, queue_size=10)
        rospy.Subscriber("number", Int32, self.on_number)

    def on_number(self, msg):
        self.near, self.far = self.far, self.near
        self.swapped.publish(Int32(data=self.near))
        self.count.publish(Int32(data=int(msg.data == 3) + (msg.data > 0)))
        for i in (3, 5, 8):
            if i == msg.data:
                break
        else:
            i = -1
        self.found.publish(Int32(data=i))
        match msg.data:
            case 0 | 1:
                k = 1
            case -1:
                k = 2
            case n if n > 10:
                k = 3
            case _:
                k = 4
        self.kind.publish(Int32(data=k))
        if (level := msg.data or 7) > 6 and self.is_low:
            self.level.publish(Int32(data=self.limited(level)))
            self.near = self.far = 1

    @property
    def is_low(self):
        return self.near < 2

    def limited(self, value):
        most = 9
        if value > most:
            return most
        return value


if __name__ == "__main__":
    rospy.init_node("idioms")
    idioms = Idioms()
    rospy.spin()
