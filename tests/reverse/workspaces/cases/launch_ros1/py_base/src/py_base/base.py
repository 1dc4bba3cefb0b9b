import rospy
from std_msgs.msg import Int32


class Base:
    def __init__(self):
        self.count = 0
        self.pub = rospy.Publisher("alarm", Int32, queue_size=10)

    def send(self, value):
        m = Int32()
        m.data = value
        self.pub.publish(m)


class Unused:
    def __init__(self):
        self.pub = rospy.Publisher("other", Int32, queue_size=10)
        rospy.Subscriber("x", Int32, self.cb)

    def cb(self, msg):
        self.pub.publish(msg)
