import rospy
from std_msgs.msg import Int32

pub = rospy.Publisher("alarm", Int32, queue_size=10)


def on_go(msg):
    m = Int32()
    m.data = 2
    pub.publish(m)


sub = rospy.Subscriber("go", Int32, on_go)


class Base:
    def __init__(self):
        self.count = 0
        self.pub = rospy.Publisher("alarm", Int32, queue_size=10)

    def send(self, value):
        m = Int32()
        m.data = value
        self.pub.publish(m)
