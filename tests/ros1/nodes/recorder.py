"""A ROS node that drives the simulated clock and writes what it hears as JSON lines.

Runs under the system's Python, which has rospy: `recorder.py CONFIG.json`. The clock stands still
until this node is connected to everything that the expected nodes publish, so nothing is missed.
It goes on only when the nodes have done all that they do at a moment: a busy machine slows the
model, and nothing else.
Says `done` when the run is over, and listens on until its standard input ends.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from xmlrpc.client import ServerProxy

import genpy
import rosgraph
import roslib.message
import rospy
from rosgraph_msgs.msg import Clock, Log

FIRST_TICK = 100.0
# What another node sends at a moment may come before that moment of the clock. So the clock goes in
# finer steps just after whole times, where nodes wait for what is sent at once.
_FINER = 4
_SETTLED = 0.08
_STILLNESS = Path(__file__).with_name("stillness.py")
SILENT = ("/clock", "/rosout", "/rosout_agg")


def plain(value: object) -> object:
    """A message as JSON data."""
    if hasattr(value, "to_sec"):
        return value.to_sec()
    if hasattr(value, "__slots__") and hasattr(value, "_type"):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, bytes):
        return list(value)
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return value


class Recorder:
    """Hears what the expected nodes publish, and drives their clock."""

    def __init__(self, config: dict[str, Any]) -> None:
        self.config = config
        self.master = rosgraph.Master("/recorder")
        self.lines: list[str] = []
        self.lock = threading.Lock()
        self.simulated = config["rate"] is not None
        self.tick = FIRST_TICK
        self.announced = {}
        self.last_served = self.clock
        self.subscribers = {}
        self.began = self.clock

    @property
    def clock(self) -> float:
        return self.tick if self.simulated else time.time()

    def write(self, kind: str, topic: str, data: object, node: str = "") -> None:
        line = {"kind": kind, "topic": topic, "stamp": round(self.clock, 6), "data": data}
        if node:
            line["node"] = node
        with self.lock:
            self.lines.append(json.dumps(line))

    def hear(self, message: genpy.Message, topic: str) -> None:
        data = plain(message)
        if topic.endswith("/startup"):
            self.announced[message.rebec] = (message.zero or message.stamp) / 1e9
        if hasattr(message, "server"):
            self.last_served = self.clock
        self.write("message", topic, data, message._connection_header.get("callerid", ""))

    def hear_log(self, message: Log) -> None:
        if message.name == rospy.get_name():
            return
        data = {"node": message.name, "level": message.level, "text": message.msg}
        self.write("log", "/rosout", data)

    def publications(self) -> dict[str, set[str]]:
        """Each topic's publishers, of those that the launch file's nodes publish."""
        expected = set(self.config["nodes"])
        publishers = {topic: set(nodes) & expected for topic, nodes in self.state()[0]}
        return {topic: nodes for topic, nodes in publishers.items() if nodes}

    def state(self) -> list[list[tuple[str, list[str]]]]:
        return self.master.getSystemState()

    def await_nodes(self) -> None:
        """Wait until all nodes are there and have stopped registering topics."""
        before, since = None, time.monotonic()
        while time.monotonic() - since < self.config["settle"]:
            state = self.state()
            present = {node for part in state[:2] for _, nodes in part for node in nodes}
            if state != before or not present >= set(self.config["nodes"]):
                before, since = state, time.monotonic()
            self.check_time()
            time.sleep(0.05)

    def check_time(self) -> None:
        if time.monotonic() > self.config["deadline"]:
            raise TimeoutError("the nodes did not come up: " + repr(self.state()))

    def subscribe(self) -> None:
        types = dict(self.master.getTopicTypes())
        for topic in self.publications():
            message_class = roslib.message.get_message_class(types.get(topic, "*"))
            if topic in SILENT or message_class is None:
                continue
            self.subscribers[topic] = rospy.Subscriber(
                topic, message_class, self.hear, callback_args=topic, tcp_nodelay=True
            )
        self.subscribers["/rosout"] = rospy.Subscriber("/rosout", Log, self.hear_log)

    def await_connections(self, clock: rospy.Publisher) -> None:
        publications = self.publications()
        while not self.connected(clock, publications):
            self.check_time()
            time.sleep(0.02)
        time.sleep(self.config["settle"])  # a publisher counts a connection a little later

    def connected(self, clock: rospy.Publisher, publications: dict[str, set[str]]) -> bool:
        listeners = dict(self.state()[1]).get("/clock", [])
        return clock.get_num_connections() >= len(listeners) and all(
            subscriber.get_num_connections() >= len(publications.get(topic, ()))
            for topic, subscriber in self.subscribers.items()
        )

    def processes(self) -> list[int]:
        """Those of the nodes, and this one."""
        return [os.getpid(), *map(self.process, self.config["nodes"])]

    def process(self, node: str) -> int:
        return int(ServerProxy(self.master.lookupNode(node)).getPid("/recorder")[2])

    def rebecs(self) -> set[str]:
        """The rebecs that start together, in any namespace."""
        names = [n for n in rospy.get_param_names() if n.endswith("/mailbox/rebecs")]
        return {rebec for name in names for rebec in rospy.get_param(name)}

    def await_startup(self, clock: rospy.Publisher) -> None:
        """Tick, without moving on, until every rebec has announced itself to the others."""
        expected = self.rebecs()
        limit = time.monotonic() + self.config["startup"]
        while not expected <= set(self.announced) and time.monotonic() < limit:
            self.publish(clock)
            time.sleep(0.05)
        time.sleep(self.config["settle"])
        self.began = self.last_served = self.clock

    def publish(self, clock: rospy.Publisher) -> None:
        if self.simulated:
            clock.publish(Clock(rospy.Time.from_sec(self.tick)))

    @contextmanager
    def watched(self) -> Iterator[Callable[[], None]]:
        """What waits until the nodes and this one have nothing to do, on a simulated clock."""
        if not self.simulated:
            yield lambda: None
            return
        command = [sys.executable, str(_STILLNESS), *map(str, self.processes())]
        with subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
        ) as watch:

            def await_stillness() -> None:
                watch.stdin.write("\n")
                watch.stdout.readline()

            yield await_stillness
            watch.stdin.close()

    def run_clock(self, clock: rospy.Publisher, await_stillness: Callable[[], None]) -> None:
        """Step the clock to the end of the run, each time when all nodes wait."""
        fine = self.config["step"] / _FINER
        started, ticks = time.monotonic(), 0
        while not self.finished():
            ticks += 1 if ticks * fine % 1 < _SETTLED else _FINER
            self.tick = FIRST_TICK + ticks * fine
            self.publish(clock)
            await_stillness()
            ahead = started + ticks * fine / (self.config["rate"] or 1) - time.monotonic()
            if ahead > 0:
                time.sleep(ahead)
            else:
                started -= ahead

    def finished(self) -> bool:
        quiet = self.clock - self.last_served
        return (
            rospy.is_shutdown()
            or self.clock - self.began >= self.config["until"]
            or quiet >= self.config["quiet"]
            or time.monotonic() > self.config["deadline"]
        )

    def record(self) -> None:
        clock = rospy.Publisher("/clock", Clock, queue_size=1000, tcp_nodelay=True)
        self.await_nodes()
        self.subscribe()
        self.await_connections(clock)
        self.await_startup(clock)
        with self.watched() as await_stillness:
            self.run_clock(clock, await_stillness)
        time.sleep(self.config["settle"])
        self.write("end", "", {"announced": self.announced})
        print("done", flush=True)
        sys.stdin.read()
        with self.lock:
            Path(self.config["out"]).write_text("\n".join(self.lines))


def await_master(limit: float) -> None:
    while True:
        try:
            rosgraph.Master("/recorder").getPid()
            return
        except (OSError, rosgraph.MasterException):
            if time.monotonic() > limit:
                raise
            time.sleep(0.05)


def main(path: Path) -> None:
    sys.setswitchinterval(0.0005)  # what is heard is stamped with the clock of that moment
    config = json.loads(path.read_text())
    config["deadline"] = time.monotonic() + config["timeout"]
    await_master(config["deadline"])
    rospy.init_node("recorder", disable_signals=True, disable_rosout=True)
    Recorder(config).record()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
