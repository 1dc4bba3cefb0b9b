"""A function of the node that ends early under two conditions, and goes on behind both."""

import rospy
from std_msgs.msg import Int32, Bool


class Robot:
    def __init__(self):
        self.a = False
        self.b = 0
        self.pub = rospy.Publisher("x", Int32, queue_size=1)
        rospy.Subscriber("y", Int32, self.on)
        rospy.Subscriber("x", Int32, self.sink)

    def on(self, msg):
        self.helper(msg.data)
        self.a = True

    def sink(self, msg):
        self.b = 3

    def helper(self, v):
        if v > 3:
            if self.a:
                return
            self.pub.publish(Int32(data=5))
        self.b = 1


rospy.init_node("r")
r = Robot()
rospy.spin()
