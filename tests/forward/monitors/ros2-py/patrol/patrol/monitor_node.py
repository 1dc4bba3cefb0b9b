"""Compares what the nodes do with the model patrol.rebeca, and tells on /diagnostics.

It only listens; the system runs the same without it.
"""

from __future__ import annotations

from typing import Any

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from patrol.monitor_model import MODEL
from patrol.monitor_run import ERROR, WARN, Status, Watch, observed
from patrol.startup import declared, spin, stoppable
from patrol_interfaces.msg import Announcement, CartState, StationState

_STATES = [
    StationState,
    CartState,
]
_KEPT = QoSProfile(depth=10000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_PAUSE = 0.25  # s between looks
_LOOKS = 4  # looks between two statuses that say the same
_LEVELS = (
    DiagnosticStatus.OK,
    DiagnosticStatus.WARN,
    DiagnosticStatus.ERROR,
    DiagnosticStatus.STALE,
)


class Monitor:
    """What a node hears, and what it says of that."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._watch = Watch(MODEL, timed=True)
        self._watch.set_times(
            float(declared(node, "mailbox.time_unit", 1.0, "seconds of a unit of model time")),
            float(declared(node, "mailbox.slack", 0.5, "seconds after which something is late")),
            float(declared(node, "patience", 5.0, "seconds after which it does not come any more")),
        )
        self._zero = 0  # ns
        self._level = -1
        self._looks = 0
        self._diagnostics = node.create_publisher(DiagnosticArray, "/diagnostics", 10)
        node.create_subscription(Announcement, "startup", self._hear, _KEPT)
        for rebec, state in enumerate(_STATES):
            self._listen(rebec, state)
        node.create_timer(_PAUSE, self._look, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def _listen(self, rebec: int, state: type[Any]) -> None:
        def receive(message: Any) -> None:
            self._watch.receive(observed(MODEL, rebec, message), self._clock())

        self._node.create_subscription(state, f"{MODEL.rebecs[rebec].node}/state", receive, _KEPT)

    def _hear(self, announcement: Announcement) -> None:
        if announcement.zero != 0:
            self._zero = announcement.zero

    def _clock(self) -> float | None:
        """Seconds since the common time 0."""
        if not self._zero:
            return None
        return (self._node.get_clock().now().nanoseconds - self._zero) / 1e9

    def _look(self) -> None:
        status = self._watch.status(self._clock())
        self._looks += 1
        if status.level != self._level or self._looks >= _LOOKS:
            self._tell(status)

    def _tell(self, found: Status) -> None:
        logger = self._node.get_logger()
        if found.level != self._level and found.level == ERROR:
            logger.error(found.message)
        if found.level != self._level and found.level == WARN:
            logger.warning(found.message)
        self._level, self._looks = found.level, 0
        status = DiagnosticStatus(level=_LEVELS[found.level], message=found.message)
        status.name = f"{self._node.get_fully_qualified_name()[1:]}: run of the model"
        status.hardware_id = "patrol"
        status.values = [KeyValue(key=key, value=value) for key, value in found.facts.items()]
        diagnostics = DiagnosticArray(status=[status])
        diagnostics.header.stamp = self._node.get_clock().now().to_msg()
        self._diagnostics.publish(diagnostics)


@stoppable
def main() -> None:
    """The node, until it is told to stop."""
    rclpy.init()
    node = Node("monitor")
    Monitor(node)
    spin(node)
