#!/usr/bin/env python
"""Drives between two stations when it is told to; stops when it is not."""

import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool, Int32


def make_twist(v, w):
    twist = Twist()
    twist.linear.x = v
    twist.angular.z = w
    return twist


class Patrol:
    STATIONS = 2

    def __init__(self):
        self.running = False
        self.target = 0
        self.cmd = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        self.target_pub = rospy.Publisher("target", Int32, queue_size=1)
        rospy.Subscriber("command", Bool, self.command_cb)
        rospy.Subscriber("station", Int32, self.station_cb)

    def command_cb(self, msg):
        self.running = msg.data
        if not msg.data:
            self.cmd.publish(make_twist(0.0, 0.0))

    def station_cb(self, msg):
        if not self.running:
            return
        if msg.data == self.target:
            self.target = (self.target + 1) % self.STATIONS
            self.target_pub.publish(Int32(self.target))

    def spin(self):
        rate = rospy.Rate(5)
        while not rospy.is_shutdown():
            if self.running:
                self.cmd.publish(make_twist(0.4 if self.target == 0 else -0.4, 0))
            rate.sleep()


if __name__ == "__main__":
    rospy.init_node("patrol")
    Patrol().spin()
