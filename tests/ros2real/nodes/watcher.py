"""Tells how nodes serve, from their diagnostics: `watcher.py NODES SECONDS`.

For each the bodies that it served in that time, from when as many nodes have served one, and the
longest time in which it served none, in seconds.
"""

from __future__ import annotations

import json
import sys
import time

import rclpy
from diagnostic_msgs.msg import DiagnosticArray

STARTUP = 120.0  # s, on a busy machine


class Watcher:
    """Counts from when a node has served its first body."""

    def __init__(self) -> None:
        self.served: dict[str, int] = {}
        self.since: dict[str, float] = {}
        self.longest: dict[str, float] = {}
        self.stalls: set[str] = set()

    def hear(self, message: DiagnosticArray) -> None:
        now = time.monotonic()
        for status in message.status:
            name = status.hardware_id
            served = int({v.key: v.value for v in status.values}["served"])
            if status.message.startswith("stall"):
                self.stalls.add(name)
            if served == 0:
                continue
            before = self.since.setdefault(name, now)
            self.longest[name] = max(self.longest.get(name, 0.0), now - before)
            if served != self.served.get(name):
                self.served[name], self.since[name] = served, now

    def tell(self) -> None:
        """Also what has not ended yet."""
        now = time.monotonic()
        pauses = {n: round(max(p, now - self.since[n]), 1) for n, p in self.longest.items()}
        facts = {"served": self.served, "pauses": pauses, "stalls": sorted(self.stalls)}
        print(json.dumps(facts, sort_keys=True))


def main(nodes: int, seconds: float) -> None:
    rclpy.init()
    node, watcher = rclpy.create_node("watcher"), Watcher()
    node.create_subscription(DiagnosticArray, "/diagnostics", watcher.hear, 100)
    end = time.monotonic() + STARTUP
    while len(watcher.served) < nodes and time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=1.0)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=1.0)
    watcher.tell()


if __name__ == "__main__":
    main(int(sys.argv[1]), float(sys.argv[2]))
