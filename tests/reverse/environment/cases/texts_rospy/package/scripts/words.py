#!/usr/bin/env python3
"""Goes by words."""

import rospy
from std_msgs.msg import Int32, String

STARTS = ("start", "go")
LEVELS = {"none": 0, "running": 1, "done": 2, "idle": 3}


class Words:
    RUNNING = "running"

    def __init__(self):
        self.state = "idle"
        self.level = rospy.Publisher("level", Int32, queue_size=1)
        self.status = rospy.Publisher("status", String, queue_size=1)
        rospy.Subscriber("command", String, self.on_command)

    def on_command(self, message):
        word = message.data
        if not word:
            self.enter("idle")
        elif self.state == "idle" and word in STARTS:
            self.enter("running")
        elif self.state == self.RUNNING and word == "finish":
            self.enter("done")
        elif word == "reset":
            self.enter("none")

    def enter(self, state):
        self.state = state if state != "none" else "idle"
        self.level.publish(Int32(data=LEVELS[state]))
        self.status.publish(String(data=self.state))


if __name__ == "__main__":
    rospy.init_node("words")
    Words()
    rospy.spin()
