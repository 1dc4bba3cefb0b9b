import rospy
from planning import choose
from std_msgs.msg import Bool, Int32


class Planner:
    def __init__(self):
        self.speed = rospy.Publisher("speed", Int32, queue_size=1)
        self.state = rospy.Publisher("state", Int32, queue_size=1)
        rospy.Subscriber("go", Bool, self.on_go)

    def on_go(self, message):
        self.state.publish(1)
        self.speed.publish(choose())


if __name__ == "__main__":
    rospy.init_node("planner")
    planner = Planner()
    rospy.spin()
