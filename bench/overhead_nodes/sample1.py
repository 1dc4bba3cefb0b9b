"""Prints the seconds of a round trip, one line for each of some windows: `sample1.py N SECONDS`.

What has been counted stands in the latched state: between its two looks nobody listens.
"""

import sys
import time

import rospy
from ping.msg import PingerState


def look():
    state = rospy.wait_for_message("/a/state", PingerState, timeout=30)
    return state.n, time.perf_counter()


rospy.init_node("sample", disable_rosout=True)
look()
time.sleep(2)
for _ in range(int(sys.argv[1])):
    (before, start), _ = look(), time.sleep(float(sys.argv[2]))
    after, end = look()
    print((end - start) / max(after - before, 1), flush=True)
