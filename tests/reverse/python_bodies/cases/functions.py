#!/usr/bin/env python3
# Functions of Python whose values the model says in other words.
import random

import rospy
from std_msgs.msg import Int32

LIMITS = (2, 5, 9)
SPEEDS = {1: 4, 3: 12}


class Functions:
    def __init__(self):
        self.pub = rospy.Publisher("limit", Int32, queue_size=1)
        self.a = 1
        self.b = 2
        self.on = self.d = False
        self.c = self.e = self.f = self.g = self.h = self.turns = 0
        self.speed = 0.5
        rospy.Subscriber("number", Int32, self.on_number)
        rospy.Subscriber("more", Int32, self.on_more)
        rospy.Subscriber("lost", Int32, self.on_lost)
        rospy.Subscriber("limit", Int32, self.on_more)

    def on_number(self, msg):
        self.a = msg.data if 0 <= msg.data <= 40 else 3
        self.b = sum((self.a, 2, True))
        self.b = sum(limit for limit in LIMITS if limit > self.a)
        self.b = min(LIMITS, key=lambda limit: abs(limit - self.a))
        self.b = max(self.a, self.b, 7)
        self.speed = max(self.a, self.speed)
        self.on = self.a not in (self.b, 4)
        self.on = self.a in range(2, 6)
        self.on = any(self.a == place * 2 for place, _ in enumerate(LIMITS, 1))
        self.on = all(low < high for low, high in zip(LIMITS, (self.a, 6, 10)))
        if self.on:
            self.pub.publish(self.b)

    def on_more(self, msg):
        self.b = {0: self.a, 1: 7, 0: 8}.get(self.a, self.b)
        self.a = SPEEDS.get(self.b, 0)
        self.b = random.choice((1, 4))
        self.b = len([self.a, self.b])

    def on_lost(self, msg):
        self.c = min(self.turn(), 3)
        self.d = any([self.turn() > 0, self.c > 3])
        self.e = random.choice((1, self.a))
        self.f = sum((self.speed, 1))
        self.g = self.b or 4
        self.h = 1 + sum({self.a, self.b})
        if self.d or self.e > 2 or self.f == 1 or self.h == self.g:
            self.pub.publish(self.c)

    def turn(self):
        self.turns += 1
        return self.turns


if __name__ == "__main__":
    rospy.init_node("functions")
    Functions()
    rospy.spin()
