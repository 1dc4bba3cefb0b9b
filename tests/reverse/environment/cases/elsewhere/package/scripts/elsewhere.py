import rospy
from motors import brake
from std_msgs.msg import Bool, Int32


class Elsewhere:
    def __init__(self):
        self.speed = rospy.Publisher("speed", Int32, queue_size=1)
        rospy.Subscriber("go", Bool, self.on_go)
        rospy.Subscriber("stop", Bool, self.on_stop)

    def on_go(self, message):
        self.speed.publish(2 if message.data else 1)

    def on_stop(self, message):
        brake(self)
        self.speed.publish(0)


if __name__ == "__main__":
    rospy.init_node("elsewhere")
    elsewhere = Elsewhere()
    rospy.spin()
