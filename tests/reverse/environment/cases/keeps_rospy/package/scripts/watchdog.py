#!/usr/bin/env python
"""Repeats the last command; stops the base when none came for a while."""

import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool


class Watchdog:
    def __init__(self):
        self.last = Twist()
        self.timed_out = True
        self.timer = None
        self.pub = rospy.Publisher("cmd_vel", Twist, queue_size=10)
        self.alarm_pub = rospy.Publisher("alarm", Bool, queue_size=1, latch=True)
        self.sub = rospy.Subscriber("cmd_vel_in", Twist, self.on_command)
        self.repeat = rospy.Timer(rospy.Duration(0.25), self.on_repeat)

    def on_command(self, msg):
        self.last = msg
        self.timed_out = False
        if self.timer is not None:
            self.timer.shutdown()
        self.timer = rospy.Timer(rospy.Duration(1.0), self.on_timeout, oneshot=True)
        self.alarm_pub.publish(False)

    def on_timeout(self, event):
        self.timed_out = True
        self.last = Twist()
        self.alarm_pub.publish(Bool(data=True))
        self.pub.publish(self.last)

    def on_repeat(self, event):
        if not self.timed_out:
            self.pub.publish(self.last)


if __name__ == "__main__":
    rospy.init_node("watchdog")
    watchdog = Watchdog()
    rospy.spin()
