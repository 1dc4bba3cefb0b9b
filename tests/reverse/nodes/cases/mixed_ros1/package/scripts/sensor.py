#!/usr/bin/env python3
import rospy
from std_msgs.msg import Bool, Int32


class Sensor:
    def __init__(self):
        self.level = rospy.get_param("~first")
        self.alarmed = False
        self.pub = rospy.Publisher("level", Int32, queue_size=4)
        rospy.Subscriber("alarm", Bool, self.on_alarm, queue_size=2)
        rospy.Timer(rospy.Duration(2), self.tick)

    def tick(self, event):
        if self.alarmed:
            self.level = 0
        elif self.level < 20:
            self.level = self.level + 1
        self.pub.publish(self.level)

    def on_alarm(self, msg):
        self.alarmed = msg.data


if __name__ == "__main__":
    rospy.init_node("sensor")
    Sensor()
    rospy.spin()
