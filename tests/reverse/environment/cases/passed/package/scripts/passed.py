import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool


def fill(command, speed):
    command.linear.x = speed


class Passed:
    def __init__(self):
        self.by_function = rospy.Publisher("by_function", Twist, queue_size=1)
        self.by_method = rospy.Publisher("by_method", Twist, queue_size=1)
        self.by_closure = rospy.Publisher("by_closure", Twist, queue_size=1)
        rospy.Subscriber("go", Bool, self.on_go)

    def fill(self, command):
        command.linear.x = 0.5

    def on_go(self, message):
        first = Twist()
        if message.data:
            fill(first, 0.5)
        self.by_function.publish(first)
        second = Twist()
        if message.data:
            self.fill(second)
        self.by_method.publish(second)
        third = Twist()

        def fill_third():
            third.linear.x = 0.5

        if message.data:
            fill_third()
        self.by_closure.publish(third)


if __name__ == "__main__":
    rospy.init_node("passed")
    passed = Passed()
    rospy.spin()
