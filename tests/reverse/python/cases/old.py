# Python 2: statements and operators that are gone, and a text that is no Python.
import rospy
from std_msgs.msg import String


def callback(msg):
    print "heard %s" % msg.data,
    try:
        raise ValueError, "no"
    except ValueError, error:
        print >>out, `error`
    if msg.data <> "":
        exec "pass"


rospy.init_node("old_" + ur"one")  #= node "old_one"
rospy.Subscriber("in", String, callback, queue_size=010)  #= subscription "in" "std_msgs/String" 8 -> callback
