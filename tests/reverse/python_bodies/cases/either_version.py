"""What Python 2 and 3 do each in their way, in a file that may be of either."""

import rospy
from std_msgs.msg import Int32

SIZES = (3, 4)


class Log:
    def __init__(self):
        self.log = []
        self.least = self.most = 0
        self.pub = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("a", Int32, self.on_a)
        rospy.Subscriber("b", Int32, self.on_b)
        rospy.Subscriber("out", Int32, self.on_out)

    def on_a(self, msg):
        size = 1
        self.most = max(size * 2 for size in SIZES)
        if self.most > size:
            self.pub.publish(Int32(size))

    def on_b(self, msg):
        size = 1
        self.least = min([size * 2 for size in SIZES])  # in Python 2, size is 4 behind it
        if self.least > size:
            self.pub.publish(Int32(size))

    def on_out(self, msg):
        self.log.append(msg.data)


if __name__ == "__main__":
    rospy.init_node("n")
    Log()
    rospy.spin()
