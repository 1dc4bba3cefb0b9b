"""The drive of a generated package, without the noise: moves and delays become a way.

The rules are those of `forward/templates/*/drive`: a move takes the time of the next delay of its
body, else that of the one before, else one unit; moves before one delay share its time; a move that
starts late is driven up to twice as fast. A differential robot turns for a third of the time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from rebsync.checker.movement.courses import Deed
from rebsync.checker.movement.ways import Pose
from rebsync.config import Drive
from rebsync.records import dataclass

_TURNS = 1 / 3  # of the time of a move


@dataclass(frozen=True, slots=True)
class Leg:
    """A move by (x, y) cells, from when to when."""

    x: int
    y: int
    start: float
    end: float


def legs(deeds: Iterable[Deed]) -> tuple[tuple[Leg, ...], float | None]:
    """The moves of one robot, in order, and from when on they are not known, if so."""
    driven: list[Leg] = []
    pending: list[tuple[int, int]] = []
    previous = 0
    for deed in deeds:
        match deed.kind:
            case "lost":
                return tuple(driven), deed.time
            case "move":
                pending.append((deed.x, deed.y))
            case "delay" if deed.duration:
                previous = deed.duration
                driven += _planned(pending, deed.time, previous, driven)
                pending = []
            case "end":
                driven += _planned(pending, deed.time, previous or 1, driven)
                pending, previous = [], 0
            case _:
                pass
    return tuple(driven), None


def _planned(
    moves: list[tuple[int, int]], time: float, duration: float, before: list[Leg]
) -> Iterator[Leg]:
    """Moves that share a duration, after those that are driven still."""
    free = before[-1].end if before else time
    for number, (x, y) in enumerate(moves):
        share = duration / len(moves)
        planned = time + number * share
        start = max(planned, free)
        free = max(planned + share, start + share / 2)
        yield Leg(x, y, start, free)


def poses(driven: Iterable[Leg], start: Pose, drive: Drive) -> tuple[Pose, ...]:
    """The way from a pose along the moves; a robot that is holonomic looks where it always did."""
    way = [start]
    for leg in driven:
        last = way[-1]
        heading = last.heading
        if drive == "differential" and (leg.x or leg.y):
            angle = math.remainder(math.atan2(leg.y, leg.x) - heading, 2 * math.pi)
            heading += angle
        if leg.start > last.time:
            way.append(Pose(leg.start, last.x, last.y, last.heading))
        if heading != last.heading:
            turned = leg.start + (leg.end - leg.start) * _TURNS
            way.append(Pose(turned, last.x, last.y, heading))
        way.append(Pose(leg.end, last.x + leg.x, last.y + leg.y, heading))
    return tuple(way)
