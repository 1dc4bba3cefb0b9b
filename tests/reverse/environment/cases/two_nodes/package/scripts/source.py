import rospy
from std_msgs.msg import Int32


class Source:
    def __init__(self):
        self.level = rospy.Publisher("level", Int32, queue_size=5)
        self.at = 0
        rospy.Timer(rospy.Duration(0.25), self.tick)

    def tick(self, event):
        self.at = (self.at + 1) % 4
        self.level.publish(self.at)


if __name__ == "__main__":
    rospy.init_node("source")
    source = Source()
    rospy.spin()
