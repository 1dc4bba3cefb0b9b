#!/usr/bin/env python3
"""Copies what may be no message yet."""

import rospy
from std_msgs.msg import Int32


class Copies:
    def __init__(self):
        self.last = None
        self.tested = rospy.Publisher("tested", Int32, queue_size=10)
        rospy.Subscriber("cmd", Int32, self.on_cmd)

    def on_cmd(self, msg):
        last = self.last
        if last:
            self.tested.publish(1)
        else:
            self.tested.publish(2)
        self.last = msg


if __name__ == "__main__":
    rospy.init_node("copies")
    copies = Copies()
    rospy.spin()
