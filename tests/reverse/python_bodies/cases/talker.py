#!/usr/bin/env python3
"""A class that counts, and functions that listen: both in one program."""

import rospy
from std_msgs.msg import Int32

LIMIT = 3
seen = False


class Talker:
    def __init__(self):
        self.count = 0
        self.pub = rospy.Publisher("chatter", Int32, queue_size=10)
        self.timer = rospy.Timer(rospy.Duration(2.0), self.tick)

    def tick(self, event):
        msg = Int32()
        msg.data = self.count
        self.pub.publish(msg)
        self.count = (self.count + 1) % 5


def callback(msg):
    global seen
    rospy.loginfo("got %d", msg.data)
    if msg.data > LIMIT:
        seen = True
    elif seen:
        return
    total = 0
    for i in range(3):
        total += i
    seen = total == 3


def listen():
    rospy.Subscriber("chatter", Int32, callback)


if __name__ == "__main__":
    rospy.init_node("talker")
    talker = Talker()
    listen()
    rospy.spin()
