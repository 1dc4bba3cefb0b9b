#!/usr/bin/env python3
import rospy
from std_msgs.msg import Bool, Int32


class Heater:
    def __init__(self):
        self.power = 0
        self.pub = rospy.Publisher("/power", Int32, queue_size=10)
        rospy.Subscriber("/heat", Bool, self.heat)
        rospy.Timer(rospy.Duration(1.0), self.tick)

    def heat(self, msg):
        if msg.data and self.power < 5:
            self.power += 1
        elif not msg.data:
            self.power = 0

    def tick(self, event):
        self.pub.publish(Int32(self.power))


if __name__ == "__main__":
    rospy.init_node("heater")
    Heater()
    rospy.spin()
