"""The ways of robots in the plane, in cells and units of model time; Y goes up."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from typing import TypeAlias

from rebsync.checker.trace import Trace
from rebsync.records import dataclass
from rebsync.static.cells import Start


@dataclass(frozen=True, slots=True)
class Pose:
    """Where a robot is at a time, and where it looks: radians, counted from X towards Y."""

    time: float
    x: float
    y: float
    heading: float


@dataclass(frozen=True, slots=True)
class Way:
    """The way of a robot: straight and even between its poses, which are in the order of time.

    From `lost` on it is not known where the robot is.
    """

    robot: str
    class_name: str
    start: Start
    poses: tuple[Pose, ...]
    lost: float | None = None

    def at(self, time: float) -> Pose:
        """Where the robot is at a time; before its first pose and after its last one it stands."""
        after = bisect_right(self.poses, time, key=lambda pose: pose.time)
        if after == 0 or after == len(self.poses):
            return self.poses[min(after, len(self.poses) - 1)]
        one, other = self.poses[after - 1], self.poses[after]
        share = (time - one.time) / (other.time - one.time)
        return Pose(
            time,
            one.x + (other.x - one.x) * share,
            one.y + (other.y - one.y) * share,
            one.heading + (other.heading - one.heading) * share,
        )


@dataclass(frozen=True, slots=True)
class Encounter:
    """Two robots nearer to each other than half a cell, from `start` to `end`.

    At `time` they are nearest, `distance` cells apart.
    """

    robots: tuple[str, str]
    start: float
    end: float
    time: float
    distance: float


@dataclass(frozen=True, slots=True)
class Movement:
    """The ways of all robots of a run from `begin` to `until`.

    Moves that it began are driven to their end, which is at `end`. `nearest` is the closest that
    two robots come, None when there are no two whose cells are known.
    """

    ways: tuple[Way, ...]
    until: float
    end: float
    encounters: tuple[Encounter, ...] = ()
    nearest: Encounter | None = None
    begin: float = 0.0


Moving: TypeAlias = Callable[[Trace], Movement | None]
"""Gives the movement of the robots in a run; None where there are none that move."""


def nowhere(trace: Trace) -> None:
    """The movement in a model without moves."""
    return
