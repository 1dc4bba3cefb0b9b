# Names and types: literals, constants, attributes, arguments, texts that are put together.
import sys

import geometry_msgs.msg as gm
import rospy
from std_msgs.msg import *

PREFIX = "arm"
DEPTH = 5


class Arm(object):
    suffix = "state"

    def __init__(self, name, side="left"):
        self.name = name
        self.topic = PREFIX + "/" + side
        rospy.Publisher(self.topic, String, queue_size=DEPTH)  #= publisher "arm/left" | "arm/right" "std_msgs/String" 5
        rospy.Publisher("%s_%d" % (self.name, 3), gm.Twist, queue_size=2 * DEPTH)  #= publisher "one_3" | "two_3" "geometry_msgs/Twist" 10
        rospy.Publisher("{}/{}".format(PREFIX, self.suffix), gm.Pose, queue_size=1, latch=True)  #= publisher "arm/state" "geometry_msgs/Pose" 1 latched=true
        rospy.Publisher(f"{PREFIX}_f", Bool, queue_size=1)  #= publisher "arm_f" "std_msgs/Bool" 1
        rospy.Publisher("/".join([PREFIX, "j"]), Bool, queue_size=1)  #= publisher "arm/j" "std_msgs/Bool" 1
        rospy.Publisher(sys.argv[1] + "/x", Bool, queue_size=1)  #= publisher ? "*/x" "std_msgs/Bool" 1
        rospy.Publisher("no_queue", Bool)  #= publisher "no_queue" "std_msgs/Bool" ?
        rospy.Publisher(rospy.get_name() + "/own", Bool, queue_size=1)  #= publisher "~own" "std_msgs/Bool" 1
        for part in ("a", "b"):
            rospy.Publisher(part, Bool, queue_size=1)  #= publisher "a" | "b" "std_msgs/Bool" 1
        for key, number in {"c": 1, "d": 2}.items():
            rospy.Publisher(key, Bool, queue_size=number)  #= publisher "c" | "d" "std_msgs/Bool" 1 | 2
        if rospy.is_shutdown():
            chosen = "yes"
        else:
            chosen = "no"
        rospy.Publisher(chosen, Bool, queue_size=1)  #= publisher "yes" | "no" "std_msgs/Bool" 1
        chosen = "sure"
        rospy.Publisher(chosen, Bool, queue_size=1)  #= publisher "sure" "std_msgs/Bool" 1
        chosen += "ly"
        rospy.Publisher(chosen, Bool, queue_size=1)  #= publisher "surely" "std_msgs/Bool" 1
        rospy.Publisher(self.full(), Bool, queue_size=1)  #= publisher "full" "std_msgs/Bool" 1

    def full(self):
        return "full"


if __name__ == "__main__":
    rospy.init_node("arms_" + Arm.suffix, anonymous=True)  #= node "arms_state" anonymous
    Arm("one")
    Arm("two", side="right")
