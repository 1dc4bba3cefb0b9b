"""Prints the seconds of a round trip between one mark and the next: `marks2.py PACKAGE SECONDS`."""

import importlib
import sys
import time
from itertools import pairwise

import rclpy

RefereeMark = importlib.import_module(sys.argv[1] + ".msg").RefereeMark


def mark(message: RefereeMark) -> None:
    marks.append((time.perf_counter(), message.k))


def spin(seconds: float) -> None:
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        rclpy.spin_once(node, timeout_sec=0.1)


marks = []
rclpy.init()
node = rclpy.create_node("marks")
subscription = node.create_subscription(RefereeMark, "/c/mark", mark, 1000)
while len(marks) < 2:
    rclpy.spin_once(node, timeout_sec=0.1)
spin(1.0)
del marks[:-1]
spin(float(sys.argv[2]))
for (before, k), (after, n) in pairwise(marks):
    print((after - before) / (n - k))
