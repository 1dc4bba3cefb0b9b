import rospy
from std_msgs.msg import Bool, Int32


class Rates:
    def __init__(self):
        self.fast = rospy.Publisher("fast", Int32, queue_size=1)
        self.slow = rospy.Publisher("slow", Bool, queue_size=1)
        self.count = 0
        rospy.Timer(rospy.Duration(1.0 / 30), self.on_fast)
        rospy.Timer(rospy.Duration(0.2), self.on_slow)

    def on_fast(self, event):
        self.count = min(self.count + 1, 7)
        self.fast.publish(self.count)

    def on_slow(self, event):
        self.slow.publish(self.count < 5)
        self.count = 0


if __name__ == "__main__":
    rospy.init_node("rates")
    rates = Rates()
    rospy.spin()
