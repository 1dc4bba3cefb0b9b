"""The drive: when moves begin and end, and where robots look."""

from __future__ import annotations

import math

import pytest

from rebsync.checker.movement.courses import Deed
from rebsync.checker.movement.drive import Leg, legs, poses
from rebsync.checker.movement.ways import Pose


def move(time: int, x: int, y: int) -> Deed:
    return Deed("r", time, "move", x, y)


def delay(time: int, duration: int) -> Deed:
    return Deed("r", time, "delay", duration=duration)


def end(time: int) -> Deed:
    return Deed("r", time, "end")


# The same cases as tests/ros1/test_drive.py has for the generated drives.
CASES = {
    "next delay": ([delay(0, 1), move(1, 1, 0), delay(1, 4), end(5)], [(1, 5)]),
    "shared": ([move(0, 1, 0), move(0, 0, 1), delay(0, 4), end(4)], [(0, 2), (2, 4)]),
    "last delay": ([delay(0, 3), move(3, 1, 0), end(3)], [(3, 6)]),
    "none": ([move(0, 1, 0), end(0)], [(0, 1)]),
    "no time": ([move(0, 1, 0), delay(0, 0), delay(0, 2), end(2)], [(0, 2)]),
    "a new body has no last delay": ([delay(0, 3), end(3), move(3, 1, 0), end(3)], [(3, 4)]),
    "late": ([move(0, 1, 0), end(0), move(0, 1, 0), end(0)], [(0, 1), (1, 1.5)]),
    "in time": ([move(0, 1, 0), end(0), move(4, 1, 0), end(4)], [(0, 1), (4, 5)]),
}


@pytest.mark.parametrize("name", CASES)
def test_moves_take_the_time_that_they_have(name: str) -> None:
    deeds, times = CASES[name]
    driven, lost = legs(deeds)
    assert [(leg.start, leg.end) for leg in driven] == times
    assert lost is None


def test_after_a_move_that_is_not_known_nothing_is() -> None:
    known = [move(0, 1, 0), delay(0, 2), end(2)]
    driven, lost = legs([*known, Deed("r", 5, "lost"), delay(5, 2), end(7), *known])
    assert (len(driven), lost) == (1, 5)


def test_a_holonomic_robot_looks_where_it_always_did() -> None:
    way = poses([Leg(0, 1, 1, 3), Leg(-1, 0, 3, 4)], Pose(0, 5, 5, 0.7), "holonomic")
    assert way == (Pose(0, 5, 5, 0.7), Pose(1, 5, 5, 0.7), Pose(3, 5, 6, 0.7), Pose(4, 4, 6, 0.7))


def test_a_differential_robot_turns_first_and_the_short_way() -> None:
    driven = [Leg(0, 1, 0, 3), Leg(-1, 0, 3, 6), Leg(-1, -1, 6, 9), Leg(0, 0, 9, 10)]
    way = poses(driven, Pose(0, 0, 0, 0), "differential")
    assert [(p.time, p.x, p.y) for p in way] == [
        (0, 0, 0), (1, 0, 0), (3, 0, 1), (4, 0, 1), (6, -1, 1), (7, -1, 1), (9, -2, 0), (10, -2, 0),
    ]  # fmt: skip
    turns = [pose.heading for pose in way]
    quarter = math.pi / 4
    assert turns == pytest.approx([quarter * n for n in (0, 2, 2, 4, 4, 5, 5, 5)])
