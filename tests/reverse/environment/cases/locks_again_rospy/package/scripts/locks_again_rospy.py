#!/usr/bin/env python3
import threading

import rospy
from std_msgs.msg import Int32

first = threading.Lock()
again = threading.RLock()


def send(value):
    with again:
        out.publish(Int32(value))


def take(message):
    with again:
        send(1)


rospy.init_node("node")
out = rospy.Publisher("out", Int32, queue_size=1)
rospy.Subscriber("go", Int32, take)
rospy.spin()
