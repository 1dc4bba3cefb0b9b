import rospy
from std_msgs.msg import Bool


class Other:
    def __init__(self):
        self.quiet = rospy.Publisher("go", Bool, queue_size=1)
        rospy.Timer(rospy.Duration(1.0), self.tick)

    def tick(self, event):
        self.quiet.publish(False)


if __name__ == "__main__":
    rospy.init_node("other")
    other = Other()
    rospy.spin()
