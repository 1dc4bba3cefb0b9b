# Names after tests of them, and parameters that an exception sets.
import rospy
from std_msgs.msg import Int32


class Guarded:
    def __init__(self):
        rospy.init_node("guarded")  #= node "guarded"
        try:
            self.prefix = rospy.get_param("~prefix")  #= parameter get "~prefix"
            if self.prefix != "":
                self.prefix = "/" + self.prefix
        except KeyError:
            self.prefix = ""
        self.a = rospy.Publisher(self.prefix + "/a", Int32, queue_size=1)  #= publisher {"~prefix" = "/a" : ('/' + value) + '/a'} "std_msgs/Int32" 1
        for word in rospy.get_param("~words"):  #= parameter get "~words"
            rospy.Publisher(self.prefix + "/" + word + "/b", Int32, queue_size=1)  #= publisher ? "*/*/b" "std_msgs/Int32" 1
        name = rospy.get_param("~name", "none")  #= parameter get "~name" = "none"
        if name == "none":
            name = "c"
        rospy.Publisher(name, Int32, queue_size=1)  #= publisher {"~name" = "none"} | "c" "std_msgs/Int32" 1
        try:
            rate = rospy.get_param("rate")  #= parameter get "rate"
        except KeyError:
            rate = 5.0
        rospy.Rate(rate)  #= rate {"rate" = 5.0}
        either = rospy.get_param("either")  #= parameter get "either"
        if either != "d":
            either = "e"
        else:
            either = "f"
        rospy.Publisher(either, Int32, queue_size=1)  #= publisher "e" | "f" "std_msgs/Int32" 1
        topic = "d"
        if topic != "d":
            topic = "g"
        rospy.Publisher(topic, Int32, queue_size=1)  #= publisher "d" | "g" "std_msgs/Int32" 1
