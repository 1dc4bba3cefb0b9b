"""Encounters against the distance of robots at many times, of drawn ways."""

from __future__ import annotations

import math
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from rebsync.checker.movement.encounters import NEAR, encounters, nearest
from rebsync.checker.movement.ways import Pose, Way
from rebsync.static.cells import Start

TICKS = 20  # for each unit of time
KNOWN = Start(0, 0, ("x", "y"))


@st.composite
def ways(draw: st.DrawFn, name: str) -> Way:
    """A way that jumps nowhere."""
    x, y, time = draw(st.integers(0, 3)), draw(st.integers(0, 3)), 0
    poses = [Pose(0, x, y, 0)]
    for _ in range(draw(st.integers(0, 6))):
        x, y = x + draw(st.integers(-1, 1)), y + draw(st.integers(-1, 1))
        time += draw(st.integers(1, 3))
        poses.append(Pose(time, x, y, 0))
    return Way(name, "R", KNOWN, tuple(poses))


@given(ways("a"), ways("b"), st.integers(0, 12))
def test_they_are_where_the_distance_is_small(one: Way, other: Way, end: int) -> None:
    found = encounters([one, other], end)
    closest = nearest([one, other], end)
    assert closest is not None
    least = math.inf
    for tick in range(end * TICKS + 1):
        time = tick / TICKS
        a, b = one.at(time), other.at(time)
        distance = math.dist((a.x, a.y), (b.x, b.y))
        least = min(least, distance)
        inside = any(each.start - 1e-9 <= time <= each.end + 1e-9 for each in found)
        if distance < NEAR - 1e-9:
            assert inside, time
        if distance > NEAR + 1e-9:
            assert not inside, time
    assert closest.distance <= least + 1e-9
    assert closest.distance >= least - 3 / TICKS
    for each in found:
        a, b = one.at(each.time), other.at(each.time)
        assert math.isclose(math.dist((a.x, a.y), (b.x, b.y)), each.distance, abs_tol=1e-9)
        assert each.start <= each.time <= each.end


@given(ways("a"), ways("b"))
def test_they_are_apart_in_time_and_in_order(one: Way, other: Way) -> None:
    found = encounters([one, other], 12)
    assert all(a.end < b.start for a, b in pairwise(found))


def test_robots_whose_cells_are_not_known_meet_nobody() -> None:
    one = Way("a", "R", KNOWN, (Pose(0, 0, 0, 0),))
    other = Way("b", "R", Start(), (Pose(0, 0, 0, 0),))
    assert encounters([one, other], 5) == ()
    assert nearest([one, other], 5) is None


def test_what_is_lost_meets_nobody_from_then_on() -> None:
    one = Way("a", "R", KNOWN, (Pose(0, 0, 0, 0), Pose(10, 0, 0, 0)))
    other = Way("b", "R", KNOWN, (Pose(0, 1, 0, 0), Pose(4, 0, 0, 0)), 3)
    (meeting,) = encounters([one, other], 10)
    assert (meeting.start, meeting.end, meeting.time) == (2, 3, 3)
