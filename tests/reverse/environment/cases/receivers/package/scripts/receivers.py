import rospy
from std_msgs.msg import Bool, Float64


class Near:
    def __init__(self):
        self.alarm = rospy.Publisher("near", Bool, queue_size=1)
        rospy.Subscriber("range", Float64, self.on_range)

    def on_range(self, message):
        self.alarm.publish(message.data < 0.3)


class Far:
    def __init__(self):
        self.alarm = rospy.Publisher("far", Bool, queue_size=1)
        rospy.Subscriber("range", Float64, self.on_range)

    def on_range(self, message):
        self.alarm.publish(message.data > 0.1)


if __name__ == "__main__":
    rospy.init_node("receivers")
    near = Near()
    far = Far()
    rospy.spin()
