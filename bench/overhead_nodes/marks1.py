"""Prints the seconds of a round trip between one mark and the next: `marks1.py SECONDS`."""

import sys
import time
from itertools import pairwise

import rospy
from ping.msg import RefereeMark


def mark(message: RefereeMark) -> None:
    marks.append((time.perf_counter(), message.k))


marks = []
rospy.init_node("marks", disable_rosout=True)
subscriber = rospy.Subscriber("/c/mark", RefereeMark, mark, tcp_nodelay=True)
while len(marks) < 2 and not rospy.is_shutdown():
    time.sleep(0.1)
time.sleep(1.0)
del marks[:-1]
time.sleep(float(sys.argv[1]))
for (before, k), (after, n) in pairwise(marks):
    print((after - before) / (n - k))
