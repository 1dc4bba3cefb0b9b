"""A node of ROS 2 that drives the simulated clock and writes what it hears as JSON lines.

Runs under a Python that has rclpy: `recorder.py CONFIG.json`. The clock stands still until this
node has subscribed to everything that the expected nodes publish, so nothing is missed. Says `done`
when the run is over, and listens on until its standard input ends.
"""

from __future__ import annotations

import json
import sys
import threading
import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import rclpy
from rcl_interfaces.msg import Log
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rclpy.time import Time
from rclpy.topic_endpoint_info import TopicEndpointInfo
from rosgraph_msgs.msg import Clock

FIRST_TICK = 100.0
SILENT = ("/clock", "/rosout", "/parameter_events")
LEVELS = {10: 1, 20: 2, 30: 4, 40: 8, 50: 16}  # those of ROS 1, as the tests know them
STATE, DEEP = DurabilityPolicy.TRANSIENT_LOCAL, 10_000


def plain(value: object) -> object:
    """A message as JSON data."""
    if hasattr(value, "sec") and hasattr(value, "nanosec"):
        return value.sec + value.nanosec * 1e-9
    if hasattr(value, "get_fields_and_field_types"):
        return {name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, bytes):
        return value[0]  # a byte
    return [plain(item) for item in value] if isinstance(value, list) else value


class Recorder:
    """Hears what the expected nodes publish, and drives their clock."""

    def __init__(self, config: dict[str, Any]) -> None:
        self.config = config
        self.node = rclpy.create_node("recorder", enable_rosout=False)
        self.lines: list[str] = []
        self.lock = threading.Lock()
        self.simulated = config["rate"] is not None
        self.tick = FIRST_TICK
        self.announced: dict[str, float] = {}
        self.last_served = self.began = self.clock

    @property
    def clock(self) -> float:
        return self.tick if self.simulated else time.time()

    def write(self, kind: str, topic: str, data: object) -> None:
        line = {"kind": kind, "topic": topic, "stamp": round(self.clock, 6), "data": data}
        with self.lock:
            self.lines.append(json.dumps(line))

    def hear(self, topic: str, message: object) -> None:
        data = plain(message)
        if topic.endswith("/startup"):
            self.announced[data["rebec"]] = (data["zero"] or data["stamp"]) / 1e9
        if hasattr(message, "server"):
            self.last_served = self.clock
        self.write("message", topic, data)

    def hear_log(self, message: Log) -> None:
        name = message.name.rsplit(".", 1)[-1]
        data = {"node": name, "level": LEVELS[message.level], "text": message.msg}
        self.write("log", "/rosout", data)

    # --- the graph ------------------------------------------------------------------------------

    def publishers(self) -> dict[str, list[TopicEndpointInfo]]:
        """The publishers of each topic that the launch file's nodes have."""
        found = {}
        for topic, _ in self.node.get_topic_names_and_types():
            infos = self.node.get_publishers_info_by_topic(topic)
            own = [i for i in infos if _full_name(i) in self.config["nodes"]]
            if own and topic not in SILENT:
                found[topic] = own
        return found

    def state(self) -> object:
        """What has to stand still for all nodes to be there."""
        publishers = {topic: len(infos) for topic, infos in self.publishers().items()}
        counts = {topic: self.node.count_subscribers(topic) for topic in publishers}
        return publishers, counts, self.clock_listeners()

    def present(self) -> set[str]:
        found = self.node.get_node_names_and_namespaces()
        return {f"{space.rstrip('/')}/{name}" for name, space in found}

    def clock_listeners(self) -> int:
        return len(self.node.get_subscriptions_info_by_topic("/clock"))

    def await_nodes(self) -> None:
        """Wait until all nodes are there and have stopped making topics."""
        before, since = None, time.monotonic()
        while time.monotonic() - since < 2 * self.config["settle"]:
            state = self.state()
            if state != before or not self.present() >= set(self.config["nodes"]) or self.unready():
                before, since = state, time.monotonic()
            self.check_time()
            time.sleep(0.05)

    def unready(self) -> set[str]:
        """The rebecs' nodes that have not even made the publisher of their start."""
        rebecs = {n for n in self.config["nodes"] if n.rpartition("/")[2] in self.config["rebecs"]}
        starts = [
            i for t, infos in self.publishers().items() if t.endswith("/startup") for i in infos
        ]
        return rebecs - {_full_name(info) for info in starts}

    def check_time(self) -> None:
        if time.monotonic() > self.config["deadline"]:
            raise TimeoutError(f"the nodes did not come up: {self.present()} {self.state()}")

    def subscribe(self) -> None:
        for topic, infos in self.publishers().items():
            package, _, name = infos[0].topic_type.split("/")
            type_ = getattr(import_module(f"{package}.msg"), name)
            qualities = [i.qos_profile for i in infos]
            qos = QoSProfile(depth=DEEP)
            if all(q.durability == STATE for q in qualities):
                qos.durability = STATE
            if any(q.reliability == ReliabilityPolicy.BEST_EFFORT for q in qualities):
                qos.reliability = ReliabilityPolicy.BEST_EFFORT
            self.node.create_subscription(type_, topic, self._hears(topic), qos)
        kept = QoSProfile(depth=DEEP, durability=STATE)
        self.node.create_subscription(Log, "/rosout", self.hear_log, kept)

    def _hears(self, topic: str) -> Callable[[object], None]:
        return lambda message: self.hear(topic, message)

    # --- the run --------------------------------------------------------------------------------

    def await_connections(self, clock: Publisher) -> None:
        while clock.get_subscription_count() < self.clock_listeners():
            self.check_time()
            time.sleep(0.02)
        time.sleep(self.config["settle"])

    def await_startup(self, clock: Publisher) -> None:
        """Tick, without moving on, until every rebec has announced itself to the others."""
        expected = set(self.config["rebecs"])
        limit = time.monotonic() + self.config["startup"]
        while not expected <= set(self.announced) and time.monotonic() < limit:
            self.publish(clock)
            time.sleep(0.05)
        time.sleep(self.config["settle"])
        self.began = self.last_served = self.clock

    def publish(self, clock: Publisher) -> None:
        if self.simulated:
            clock.publish(Clock(clock=Time(nanoseconds=round(self.tick * 1e9)).to_msg()))

    def run_clock(self, clock: Publisher) -> None:
        """Step the clock to the end of the run; a machine that is too slow slows the model."""
        step, pause = self.config["step"], self.config["step"] / (self.config["rate"] or 1)
        started, ticks = time.monotonic(), 0
        while not self.finished():
            ticks += 1
            self.tick = FIRST_TICK + ticks * step
            self.publish(clock)
            ahead = started + ticks * pause - time.monotonic()
            if ahead > 0:
                time.sleep(ahead)
            else:
                started = time.monotonic() - ticks * pause

    def finished(self) -> bool:
        quiet = self.clock - self.last_served
        return (
            self.clock - self.began >= self.config["until"]
            or quiet >= self.config["quiet"]
            or time.monotonic() > self.config["deadline"]
        )

    def record(self) -> None:
        clock = self.node.create_publisher(Clock, "/clock", QoSProfile(depth=10))
        self.await_nodes()
        self.subscribe()
        self.await_connections(clock)
        self.await_startup(clock)
        self.run_clock(clock)
        time.sleep(self.config["settle"])
        self.write("end", "", {"announced": self.announced})
        print("done", flush=True)
        sys.stdin.read()
        with self.lock:
            Path(self.config["out"]).write_text("\n".join(self.lines))


def _full_name(endpoint: TopicEndpointInfo) -> str:
    return f"{endpoint.node_namespace.rstrip('/')}/{endpoint.node_name}"


def _spin(node: Node) -> None:
    try:
        rclpy.spin(node)
    except ExternalShutdownException:
        return


def main(path: Path) -> None:
    sys.setswitchinterval(0.0005)  # what is heard is stamped with the clock of that moment
    config = json.loads(path.read_text())
    config["deadline"] = time.monotonic() + config["timeout"]
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    recorder = Recorder(config)
    spinning = threading.Thread(target=_spin, args=(recorder.node,), daemon=True)
    spinning.start()
    try:
        recorder.record()
    finally:
        rclpy.try_shutdown()
        spinning.join(5)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
