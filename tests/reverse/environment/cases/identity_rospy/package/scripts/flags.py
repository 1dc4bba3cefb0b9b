#!/usr/bin/env python3
"""Says which of its values are True, False or None themselves."""
import rospy
from std_msgs.msg import Int32


class Flags:
    def __init__(self):
        self.level = 0
        self.is_high = False
        self.number = rospy.Publisher("number", Int32, queue_size=10)
        self.truth = rospy.Publisher("truth", Int32, queue_size=10)
        rospy.Subscriber("level", Int32, self.on_level, queue_size=10)

    def on_level(self, msg):
        self.level = msg.data
        self.is_high = msg.data > 3
        if self.level is True or self.level is None or True is msg.data:
            self.number.publish(Int32(data=1))
        elif self.level == True and self.level is not False and self.level != None:
            self.number.publish(Int32(data=2))
        if self.is_high is True:
            self.truth.publish(Int32(data=1))
        elif self.is_high is False and self.is_high is not None:
            self.truth.publish(Int32(data=2))
        else:
            self.truth.publish(Int32(data=3))


if __name__ == "__main__":
    rospy.init_node("flags")
    Flags()
    rospy.spin()
