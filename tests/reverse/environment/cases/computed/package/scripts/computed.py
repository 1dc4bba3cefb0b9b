import rospy
from std_msgs.msg import Bool, Int32


class Half:
    def __init__(self):
        self.far = rospy.Publisher("far", Bool, queue_size=1)
        rospy.Subscriber("range", Int32, self.on_range)

    def on_range(self, message):
        if message.data > 0 and message.data < 1000:
            self.far.publish(message.data // 2 == 321)


if __name__ == "__main__":
    rospy.init_node("half")
    half = Half()
    rospy.spin()
