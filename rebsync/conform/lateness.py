"""By how much the clock of a run differs from the time of the model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal

from rebsync.conform.conformance import Lateness
from rebsync.conform.recording import (
    Announced,
    Event,
    Heard,
    Sent,
    Served,
    Ticked,
    Truncated,
)

POINTS = 2000
_JUMP = 1.0  # s that stamps may go back: messages of one moment are recorded in any order

Point = tuple[int, str, float]


class Clocks:
    """Sees the events of a recording, and keeps what they say of clocks, in bounded memory."""

    def __init__(self, nodes: Sequence[str], time_unit: float) -> None:
        self._nodes = nodes
        self._unit = time_unit
        self._zeros: dict[float, int] = {}
        self._first: float | None = None
        self._points: list[Point] = []
        self._every = 1
        self._count = 0
        self._least: Point | None = None
        self._most: Point | None = None
        self._latest = float("-inf")
        self._jumps: list[tuple[float, float]] = []
        self._goes_back = False
        self._ticks: tuple[float, float] | None = None
        self._publishers: dict[int, dict[str, None]] = {}

    def see(self, event: Event) -> None:
        """Takes an event into account."""
        match event:
            case Announced():
                if event.zero > 0:
                    self._zeros[event.zero] = self._zeros.get(event.zero, 0) + 1
            case Ticked():
                if self._ticks is not None and event.time < self._ticks[0] - _JUMP:
                    self._jumps.append((self._ticks[0], event.time))
                self._ticks = (event.time, event.stamp)
            case Sent():
                pass
            case Truncated() | Heard():
                return
            case Served():
                self._served(event)
        if event.stamp < self._latest - _JUMP and len(self._jumps) < POINTS:
            self._goes_back = True
            self._jumps.append((self._latest, event.stamp))
            self._latest = event.stamp
        self._latest = max(self._latest, event.stamp)

    def _served(self, served: Served) -> None:
        if served.publisher:
            self._publishers.setdefault(served.rebec, {})[served.publisher] = None
        offset = served.stamp - served.now * self._unit
        point = (served.now, self._nodes[served.rebec], offset)
        if self._least is None or offset < self._least[2]:
            self._least = point
        if self._most is None or offset > self._most[2]:
            self._most = point
        if self._count % self._every == 0:
            self._points.append(point)
            if len(self._points) > POINTS:
                self._points = self._points[::2]
                self._every *= 2
        self._count += 1

    def lateness(self) -> Lateness:
        """What was seen, counted from time 0."""
        if self._least is None or self._most is None:
            return Lateness()
        basis, zero = self._zero(self._least[2])
        points = [(now, node, offset - zero) for now, node, offset in self._points]
        ends = [(p[0], p[1], p[2] - zero) for p in (self._least, self._most)]
        greatest = max(ends, key=lambda p: abs(p[2]))
        return Lateness(basis, zero, greatest, tuple(points), self._goes_back)

    def _zero(self, least: float) -> tuple[Literal["announced", "first"], float]:
        """Time 0 as announced; the earliest that fits where it was not, or on another clock."""
        if self._zeros:
            zero = max(self._zeros, key=lambda z: (self._zeros[z], z))
            if abs(least - zero) < 1e6:  # else stamps are of another clock than the nodes'
                return "announced", zero
        return "first", least

    def notes(self) -> Iterator[str]:
        """What is remarkable, as sentences without their ends."""
        if len(self._zeros) > 1:
            yield f"nodes announce {len(self._zeros)} different times 0"
        for before, after in self._jumps[:3]:
            yield f"the clock jumps back from {before:.3f} s to {after:.3f} s"
        if len(self._jumps) > 3:
            yield f"the clock jumps back {len(self._jumps)} times"
        for rebec, names in self._publishers.items():
            if len(names) > 1:
                yield f"the state of {self._nodes[rebec]} is published by {', '.join(names)}"
