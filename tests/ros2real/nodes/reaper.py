"""Kills a node of this run in the middle, and starts it again by hand where nobody else does.

`reaper.py PACKAGE EXECUTABLE RESPAWNED`: before and after it publishes what no rebec stamped.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from importlib import import_module
from pathlib import Path

import rclpy
from rclpy.node import Node

BEFORE, DEAD = 6.0, 7.0  # s
_MARK = "REBSYNC_TEST_RUN"


def process(executable: str) -> int:
    """The process of a node of this run: its environment has the mark of the run."""
    mark = f"{_MARK}={os.environ[_MARK]}".encode()
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
            marked = mark in (folder / "environ").read_bytes().split(b"\0")
        except OSError:
            continue
        started = any(word.endswith(f"/{executable}".encode()) for word in words[:2])
        if marked and started and int(folder.name) != os.getpid():
            return int(folder.name)
    raise LookupError(executable)


def main(package: str, executable: str, respawned: bool) -> None:
    rclpy.init()
    node = Node("reaper")
    messages = import_module(f"{package}.msg")
    publisher = node.create_publisher(messages.CounterCount, "/c/count", 10)
    time.sleep(BEFORE)
    publisher.publish(messages.CounterCount())
    time.sleep(0.5)
    number = process(executable)
    words = Path(f"/proc/{number}/cmdline").read_bytes().rstrip(b"\0").split(b"\0")
    os.kill(number, signal.SIGKILL)
    again = None
    if not respawned:
        time.sleep(DEAD)
        again = subprocess.Popen(words)
    try:
        rclpy.spin(node)
    except BaseException:
        if again is not None:
            again.send_signal(signal.SIGINT)
            again.wait(10)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3] == "respawned")
