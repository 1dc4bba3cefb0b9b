#!/usr/bin/env python3
# Several names for one object, and other places where idioms of Python are not read.
import rospy
from std_msgs.msg import Int32


class Idioms:
    def __init__(self):
        self.first = rospy.Publisher("first", Int32, queue_size=1)
        self.second = rospy.Publisher("second", Int32, queue_size=1)
        self.near = self.far = 1
        self.on = False
        self.lost = 0
        self.last = Int32()
        self.sub = rospy.Subscriber("number", Int32, self.on_number)
        self.sinks = rospy.Subscriber("first", Int32, self.show)
        self.sink = rospy.Subscriber("second", Int32, self.show)
        self.timer = rospy.Timer(rospy.Duration(2), self.on_timer)

    def on_timer(self, _):
        self.near, self.far = self.far, self.near
        self.first.publish(Int32(data=self.near))
        self.first.publish(Int32(data=self.on + round(2.5)))
        self.far = self.stepped(self.near or 4)
        for way in (self.near, self.far):
            if way == 2:
                break
            self.second.publish(Int32(data=way))
        else:
            self.second.publish(Int32(data=way))
        match self.far:
            case -1 | 2:
                self.on = self.on ^ True
            case other if other > self.near:
                self.on = self.is_near
        match self.near:
            case True:  # which 1 is equal to, and is not
                pass

    def stepped(self, value):
        self.near = value
        return 3 if self.is_near else 2

    @property
    def is_near(self):
        limit = 2
        if self.near > limit:
            return False
        return True

    def on_number(self, msg):
        one = other = msg
        other.data = 4
        one, other = msg, 3
        one.data = 4
        for each in (self.last, msg):
            each.data = 3
        for pub in (self.first, self.second):
            pub.publish(Int32(data=3))
        if self.on and (number := msg.data) > 3:
            self.lost = number
        match msg:
            case Int32(data=3):
                self.lost = 3

    def show(self, msg):
        self.seen = msg.data


if __name__ == "__main__":
    rospy.init_node("idioms")
    idioms = Idioms()
    rospy.spin()
