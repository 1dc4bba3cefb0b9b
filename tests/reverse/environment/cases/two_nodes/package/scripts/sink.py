import rospy
from std_msgs.msg import Bool, Int32


class Sink:
    def __init__(self):
        self.armed = False
        self.full = rospy.Publisher("full", Bool, queue_size=1)
        rospy.Subscriber("in", Int32, self.on_level)
        rospy.Subscriber("arm", Bool, self.on_arm)

    def on_arm(self, message):
        self.armed = message.data

    def on_level(self, message):
        self.full.publish(self.armed and message.data == 3)


if __name__ == "__main__":
    rospy.init_node("sink")
    sink = Sink()
    rospy.spin()
