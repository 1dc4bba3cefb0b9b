import rospy
from std_msgs.msg import Bool, Float64, Int32


class Thresholds:
    def __init__(self):
        self.low = rospy.get_param("~low", 0.25)
        self.eager = rospy.Publisher("eager", Bool, queue_size=1)
        self.near = rospy.Publisher("near", Bool, queue_size=1)
        self.limit = 3
        rospy.Subscriber("battery", Float64, self.on_battery)
        rospy.Subscriber("level", Int32, self.on_level)
        rospy.Subscriber("mode", Bool, self.on_mode)

    def on_battery(self, message):
        if message.data < self.low:
            self.eager.publish(True)
        else:
            self.eager.publish(False)

    def on_level(self, message):
        self.near.publish(message.data < self.limit)

    def on_mode(self, message):
        self.limit = 7 if message.data else 3


if __name__ == "__main__":
    rospy.init_node("thresholds")
    thresholds = Thresholds()
    rospy.spin()
