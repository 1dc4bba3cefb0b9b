import rospy
from std_msgs.msg import Bool, Int32


class Slow:
    def __init__(self):
        self.done = rospy.Publisher("done", Bool, queue_size=1)
        self.late = rospy.Publisher("late", Bool, queue_size=1)
        rospy.Subscriber("go", Int32, self.on_go, queue_size=2)

    def on_go(self, message):
        rospy.sleep(3.0)
        self.done.publish(message.data > 0)
        self.late.publish(False)


if __name__ == "__main__":
    rospy.init_node("slow")
    slow = Slow()
    rospy.spin()
