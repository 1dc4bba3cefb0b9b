import rospy
from std_msgs.msg import Bool


class Pulse:
    def __init__(self):
        self.line = rospy.Publisher("line", Bool, queue_size=1)
        self.quiet = rospy.Publisher("quiet", Bool, queue_size=1)
        rospy.Subscriber("go", Bool, self.on_go)

    def on_go(self, message):
        if not message.data:
            self.quiet.publish(True)
            self.line.publish(False)
            return
        self.quiet.publish(False)
        self.line.publish(True)
        self.line.publish(False)


if __name__ == "__main__":
    rospy.init_node("pulse")
    pulse = Pulse()
    rospy.spin()
