"""Ping-pong by hand: what the generated nodes do, and no more. The first argument is `a` or `b`."""

import sys
import time

import rospy
from ping.msg import PingerPing, PingerState, PongerPong, PongerState


def ping(message):
    global n
    n += 1
    out.publish(PongerPong(k=n))
    state.publish(PingerState(server="ping", n=n))


def pong(message):
    out.publish(PingerPing())
    state.publish(PongerState(server="pong", arguments=str(message.k), n=message.k))


n = 0
rospy.init_node(sys.argv[1])
depth = {"queue_size": 1000, "tcp_nodelay": True}
if sys.argv[1] == "a":
    out = rospy.Publisher("b/pong", PongerPong, **depth)
    state = rospy.Publisher("a/state", PingerState, queue_size=1000, latch=True)
    subscription = rospy.Subscriber("a/ping", PingerPing, ping, **depth)
    while not rospy.is_shutdown() and not out.get_num_connections():
        time.sleep(0.05)
    time.sleep(0.5)  # until the other hears, too
    ping(None)
else:
    out = rospy.Publisher("a/ping", PingerPing, **depth)
    state = rospy.Publisher("b/state", PongerState, queue_size=1000, latch=True)
    subscription = rospy.Subscriber("b/pong", PongerPong, pong, **depth)
rospy.spin()
