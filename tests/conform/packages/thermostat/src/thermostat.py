#!/usr/bin/env python3
import rospy
from std_msgs.msg import Bool, Int32


class Thermostat:
    def __init__(self):
        self.on = False
        self.pub = rospy.Publisher("/heat", Bool, queue_size=10)
        rospy.Subscriber("/temperature", Int32, self.measured)

    def measured(self, msg):
        if msg.data < 18:
            self.on = True
        elif msg.data > 22:
            self.on = False
        self.pub.publish(Bool(self.on))


if __name__ == "__main__":
    rospy.init_node("thermostat")
    Thermostat()
    rospy.spin()
