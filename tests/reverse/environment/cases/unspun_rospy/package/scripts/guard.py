#!/usr/bin/env python3
import rospy
from std_msgs.msg import Bool

class N:
    def __init__(self):
        self.p = rospy.Publisher("a", Bool, queue_size=1)
        self.sub = rospy.Subscriber("go", Bool, self.on_go)

    def on_go(self, msg):
        self.p.publish(Bool(data=msg.data))


def main():
    rospy.init_node("n")
    n = N()
    for i in range(3):
        rospy.sleep(1)

if __name__ == "__main__":
    main()
