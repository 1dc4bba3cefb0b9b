#!/usr/bin/env python3
"""Loops over what the model does not have, and messages that a callback changes."""

import copy
import sys

import rospy
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64, Int32

TICK = 0.25


class Relay:
    def __init__(self, pub):
        self.pub = pub

    def hand_on(self, value):
        self.pub.publish(value)


def fill(make):
    twist = make()
    twist.linear.near = 1
    twist.relays.near = 1
    return twist


class Scanner:
    def __init__(self):
        self.near = 0
        self.ticks = 0.0
        self.last = None
        self.relays = []
        self.near_pub = rospy.Publisher("near", Int32, queue_size=1)
        self.pose_pub = rospy.Publisher("moved", PoseStamped, queue_size=1)
        self.scan_sub = rospy.Subscriber("scan", LaserScan, self.scanned)
        self.pose_sub = rospy.Subscriber("pose", PoseStamped, self.posed)
        self.ticks_sub = rospy.Subscriber("ticks", Float64, self.ticked)

    def scanned(self, scan):
        self.last = copy.deepcopy(scan)
        self.near = 0
        for number, distance in enumerate(scan.ranges):
            if distance < 0.5:
                self.near += 1
                rospy.logdebug("%d is near", number)
            elif distance > scan.range_max:
                break
        if self.near > 3:
            self.near_pub.publish(1)

    def posed(self, pose):
        pose.header.frame_id = "map"
        pose.pose.position.x = self.offset(pose)
        if pose.pose.position.x > 0.0:
            self.near_pub.publish(2)
        for point in self.relays:
            point.hand_on(pose)
        for number in self.known():
            self.near_pub.publish(3)
        self.pose_pub.publish(pose)

    def offset(self, pose):
        return pose.pose.position.x + len(self.relays)

    def known(self):
        return [1, 2]

    def ticked(self, ticks):
        step = 0.5
        self.ticks = ticks.data / step
        rospy.loginfo("%f", ticks.data / TICK)
        unit = self.relays[0].unit / step
        rospy.loginfo("%f", unit)


class Reader:
    def __init__(self):
        self.far = False
        self.moved_sub = rospy.Subscriber("moved", PoseStamped, self.moved)

    def moved(self, pose):
        self.far = pose.pose.position.y > pose.pose.position.x


def main():
    rospy.init_node("scanner")
    scanner = Scanner()
    reader = Reader()
    rospy.spin()
    return 0


if __name__ == "__main__":
    sys.exit(main())
