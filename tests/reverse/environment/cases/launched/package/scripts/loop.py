import rospy
from std_msgs.msg import Bool, Int32


class Loop:
    def __init__(self):
        self.seen = False
        self.early = 0
        self.out = rospy.Publisher("out", Int32, queue_size=1)
        rospy.Subscriber("go", Bool, self.on_go)

    def on_go(self, message):
        self.seen = self.seen or message.data

    def run(self):
        rate = rospy.Rate(1)
        while not rospy.is_shutdown():
            if self.early < 3:
                self.early += 1
                continue
            self.out.publish(1 if self.seen else 0)
            rate.sleep()


if __name__ == "__main__":
    rospy.init_node("loop")
    loop = Loop()
    loop.run()
