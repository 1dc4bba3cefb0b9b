#!/usr/bin/env python3
"""Tells of the first level: before it, there is none."""
import rospy
from std_msgs.msg import Int32


class Late:
    level = None

    def __init__(self):
        self.changed = rospy.Publisher("changed", Int32, queue_size=10)
        rospy.Subscriber("level", Int32, self.on_level, queue_size=10)

    def on_level(self, msg):
        if self.level != 0:
            self.changed.publish(Int32(data=1))
        self.level = 0


if __name__ == "__main__":
    rospy.init_node("late")
    Late()
    rospy.spin()
