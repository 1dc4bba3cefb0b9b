"""Where robots come so near to each other that they collide."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations, pairwise

from rebsync.checker.movement.ways import Encounter, Way
from rebsync.records import dataclass

NEAR = 0.5  # cells: two robots that pass each other at a corner are 0.7 apart
_EXACT = 1e-9


@dataclass(frozen=True, slots=True)
class _Stretch:
    """From `start` to `end` the other robot is at (x, y), relative, and goes on by (dx, dy)."""

    start: float
    end: float
    x: float
    y: float
    dx: float
    dy: float

    def nearest(self) -> tuple[float, float]:
        """The least distance, and when it is that."""
        square = self.dx * self.dx + self.dy * self.dy
        share = 0.0
        if square > _EXACT:
            share = min(max(-(self.x * self.dx + self.y * self.dy) / square, 0.0), 1.0)
        distance = math.hypot(self.x + self.dx * share, self.y + self.dy * share)
        return distance, self.start + (self.end - self.start) * share

    def near(self) -> tuple[float, float] | None:
        """From when to when it is nearer than NEAR: the distance is convex over time."""
        if self.nearest()[0] >= NEAR:
            return None
        square = self.dx * self.dx + self.dy * self.dy
        if square <= _EXACT:
            return self.start, self.end
        half = (self.x * self.dx + self.y * self.dy) / square
        rest = half * half - (self.x * self.x + self.y * self.y - NEAR * NEAR) / square
        root = math.sqrt(max(rest, 0.0))
        first, last = (min(max(share, 0.0), 1.0) for share in (-half - root, -half + root))
        length = self.end - self.start
        return self.start + length * first, self.start + length * last


def encounters(ways: Sequence[Way], end: float, begin: float = 0.0) -> tuple[Encounter, ...]:
    """The times at which two robots whose cells are known are too near, in their order."""
    found = [
        encounter
        for one, other in combinations([way for way in ways if way.start.known], 2)
        if _boxes_meet(one, other)
        for encounter in _meetings(one, other, begin, _known_until(one, other, end))
    ]
    return tuple(sorted(found, key=lambda each: (each.start, each.robots)))


def nearest(ways: Sequence[Way], end: float, begin: float = 0.0) -> Encounter | None:
    """The closest that any two robots come whose cells are known."""
    found = [
        Encounter((one.robot, other.robot), time, time, time, distance)
        for one, other in combinations([way for way in ways if way.start.known], 2)
        for distance, time in [
            min(s.nearest() for s in _stretches(one, other, begin, _known_until(one, other, end)))
        ]
    ]
    return min(found, key=lambda each: (each.distance, each.time, each.robots), default=None)


def _known_until(one: Way, other: Way, end: float) -> float:
    return min([end, *(way.lost for way in (one, other) if way.lost is not None)])


def _boxes_meet(one: Way, other: Way) -> bool:
    return all(
        min(getattr(p, axis) for p in a.poses) - NEAR < max(getattr(p, axis) for p in b.poses)
        for axis in ("x", "y")
        for a, b in ((one, other), (other, one))
    )


def _stretches(one: Way, other: Way, begin: float, end: float) -> Iterator[_Stretch]:
    """Stretches of time in which both robots go straight on, at least one."""
    times = {begin, end, *(pose.time for way in (one, other) for pose in way.poses)}
    inside = sorted(time for time in times if begin <= time <= end)
    for start, until in pairwise(inside if len(inside) > 1 else [begin, begin]):
        # At a time of two poses the later one counts for what follows.
        middle = (start + until) / 2
        a, b = one.at(start), other.at(start)
        half_a, half_b = one.at(middle), other.at(middle)
        x, y = b.x - a.x, b.y - a.y
        dx, dy = 2 * (half_b.x - half_a.x - x), 2 * (half_b.y - half_a.y - y)
        yield _Stretch(start, until, x, y, dx, dy)


def _meetings(one: Way, other: Way, begin: float, end: float) -> Iterator[Encounter]:
    """The encounters of two robots: stretches that follow each other are one."""
    robots = (one.robot, other.robot)
    current: Encounter | None = None
    for stretch in _stretches(one, other, begin, end):
        near = stretch.near()
        if near is None:
            continue
        distance, time = stretch.nearest()
        if current is not None and near[0] - current.end < _EXACT:
            if current.distance <= distance:
                distance, time = current.distance, current.time
            current = Encounter(robots, current.start, near[1], time, distance)
            continue
        if current is not None:
            yield current
        current = Encounter(robots, *near, time, distance)
    if current is not None:
        yield current
