#!/usr/bin/env python3
# Loops that keep a node running, with what they keep between two rounds.
import random

import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool, UInt8

pressed = False


def on_bumper(msg):
    global pressed
    pressed = msg.data


def drive():
    rospy.init_node("driver")
    pub = rospy.Publisher("cmd_vel", Twist, queue_size=1)
    code = rospy.Publisher("code", UInt8, queue_size=1)
    rospy.Subscriber("bumper", Bool, on_bumper)
    rate = rospy.Rate(1)
    turns = 0
    while not rospy.is_shutdown():
        twist = Twist()
        if pressed:
            twist.angular.z = 1.5
            turns = min(turns + 1, 200)
        else:
            twist.linear.x = 0.2
        pub.publish(twist)
        code.publish(turns)
        rate.sleep()


class Bumper:
    def __init__(self):
        self.pub = rospy.Publisher("bumper", Bool, queue_size=1)
        self.sub = rospy.Subscriber("cmd_vel", Twist, self.moved)
        self.speed = 0.0
        self.code = rospy.Subscriber("code", UInt8, self.coded)

    def moved(self, twist):
        self.speed = max(twist.linear.x, 0.1)
        if twist.angular.z > 1:
            rospy.sleep(2)
            self.tell(False)

    def coded(self, message):
        self.tell(message.data % 3 == random.randint(0, 2))

    def tell(self, value):
        if self.speed < 0.15:
            return
        self.pub.publish(value)


if __name__ == "__main__":
    bumper = Bumper()
    try:
        drive()
    except rospy.ROSInterruptException:
        pass
