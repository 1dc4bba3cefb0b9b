#!/usr/bin/env python3
"""Stops at the third hit, and says so by one publisher; by another, that the bumper is free again."""

import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool


class Guard:
    def __init__(self):
        self.hits = 0
        self.pressed = False
        self.command = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        self.stopped = rospy.Publisher("stopped", Bool, queue_size=1, latch=True)
        self.halted = rospy.Publisher("stopped", Bool, queue_size=1)
        rospy.Subscriber("bumper", Bool, self.again, queue_size=1)
        rospy.Subscriber("bumper", Bool, self.on_bumper, queue_size=1)
        rospy.Timer(rospy.Duration(0.1), self.drive)

    def again(self, message):
        if self.hits == 3 and not message.data:
            self.halted.publish(Bool(False))

    def on_bumper(self, message):
        self.pressed = message.data
        if message.data and self.hits < 3:
            self.hits += 1
            if self.hits == 3:
                self.stopped.publish(Bool(True))

    def drive(self, event):
        command = Twist()
        if self.hits < 3 and not self.pressed:
            command.linear.x = 0.5
        elif self.hits < 3:
            command.angular.z = 1.0
        self.command.publish(command)


if __name__ == "__main__":
    rospy.init_node("guard")
    guard = Guard()
    rospy.spin()
