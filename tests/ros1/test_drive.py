"""The drive on a real roscore: velocities, integrated, end in the cells of the model."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest

from tests.ros1.probes import Player, Rebec, play
from tests.ros1.recording import Pose, Recording
from tests.ros1.run import Clock
from tests.ros1.workspace import Workspace

STEPS = ((1, 0), (0, 1), (-1, 0), (1, 1), (-1, -1), (0, -1), (1, -1))
TOLERANCE = 0.2


def robot(lines: tuple[str, ...], **drive: object) -> Rebec:
    """A rebec that runs its lines at time 0."""
    parameters = {f"drive/{name}": value for name, value in drive.items()}
    return Rebec(constructor=("send self plain 0",), plain=lines, parameters=parameters)


def pose_at(recording: Recording, rebec: str, time: float, heading: float = 0.0) -> Pose:
    """Where the robot is at a time, between two of its velocities."""
    path = recording.path(rebec, Pose(heading=heading))
    before = [Pose(heading=heading), *(pose for stamp, pose in path if stamp <= time)]
    return before[-1]


def near(pose: Pose, x: float, y: float, cell: float = 1.0) -> bool:
    """Whether the pose is in the middle of a cell, or nearly so."""
    return math.hypot(pose.x - x * cell, pose.y - y * cell) < TOLERANCE * cell


@pytest.fixture(scope="module")
def tour(probe: Workspace, tmp_path_factory: pytest.TempPathFactory) -> Recording:
    """Robots of several kinds on the same way, one cell in four seconds and a pause of one."""
    lines = tuple(line for dx, dy in STEPS for line in (f"move {dx} {dy}", "delay 4", "delay 1"))
    rebecs = {
        "holonomic": robot(lines, kind="holonomic"),
        "turned": robot(lines, kind="holonomic", heading=0.7),
        "differential": robot(lines, kind="differential"),
        "small": robot(lines, kind="differential", heading=math.pi / 2, cell_size=0.5),
    }
    directory = tmp_path_factory.mktemp("tour")
    return play(probe, directory, rebecs, Clock(until=40, quiet=37))


@pytest.mark.parametrize(
    ("name", "heading", "cell"),
    [
        ("holonomic", 0.0, 1.0),
        ("turned", 0.7, 1.0),
        ("differential", 0.0, 1.0),
        ("small", math.pi / 2, 0.5),
    ],
)
def test_every_move_ends_in_its_cell(
    tour: Recording, name: str, heading: float, cell: float
) -> None:
    x = y = 0
    for index, (dx, dy) in enumerate(STEPS):
        x, y = x + dx, y + dy
        # In the pause after the move the robot stands in the cell.
        pose = pose_at(tour, name, 5 * index + 4.9, heading)
        assert near(pose, x, y, cell), f"after move {index + 1}: {pose}, not ({x}, {y})"


@pytest.mark.parametrize(("name", "heading"), [("holonomic", 0.0), ("turned", 0.7)])
def test_a_holonomic_robot_moves_straight_and_evenly(
    tour: Recording, name: str, heading: float
) -> None:
    x = y = 0
    for index, (dx, dy) in enumerate(STEPS):
        half_way = pose_at(tour, name, 5 * index + 2.1, heading)
        assert near(half_way, x + dx / 2, y + dy / 2), f"in move {index + 1}: {half_way}"
        x, y = x + dx, y + dy


def test_a_differential_robot_turns_first_and_the_short_way(tour: Recording) -> None:
    x = y = 0
    for index, (dx, dy) in enumerate(STEPS):
        before, turned = (pose_at(tour, "differential", 5 * index + t) for t in (-0.1, 1.5))
        if index:
            assert near(turned, x, y), f"in move {index + 1}: {turned}"
            assert abs(turned.heading - before.heading) < math.pi + 0.3
        off = math.remainder(turned.heading - math.atan2(dy, dx), 2 * math.pi)
        assert abs(off) < 0.5, f"in move {index + 1}: {turned}"
        x, y = x + dx, y + dy


def test_velocities_come_at_ten_hertz_and_end_with_a_stop(tour: Recording) -> None:
    for name in ("holonomic", "differential"):
        velocities = tour.velocities(name)
        last = velocities[-1]
        assert (last.x, last.y, last.turn) == (0, 0, 0)
        stamps = [v.stamp for v in velocities if v.stamp < 3.9]
        gaps = [b - a for a, b in pairwise(stamps)]
        assert 0.05 < sorted(gaps)[len(gaps) // 2] < 0.15
        assert max(gaps) < 0.3


def test_a_differential_robot_never_slides(tour: Recording) -> None:
    assert all(v.y == 0 for v in tour.velocities("differential"))
    assert any(v.turn != 0 for v in tour.velocities("differential"))
    assert all(v.turn == 0 for v in tour.velocities("holonomic"))


def test_a_move_takes_the_time_of_the_next_delay_or_the_last_or_a_parameter(
    probe: Workspace, tmp_path: Path
) -> None:
    rebecs = {
        "next": robot(("delay 1", "move 1 0", "move 0 1", "delay 4")),
        "last": robot(("delay 3", "move 1 0")),
        "none": robot(("move 1 0",), move_time=2.0),
        "quick": robot(("move 1 0", "send self low 0")),
    }
    recording = play(probe, tmp_path, rebecs, Clock(until=30, quiet=6))
    assert near(pose_at(recording, "next", 0.9 + 1), 0.45, 0)
    assert near(pose_at(recording, "next", 3.1), 1, 0)
    assert near(pose_at(recording, "next", 5.3), 1, 1)
    assert near(pose_at(recording, "last", 4.5), 0.5, 0)
    assert near(pose_at(recording, "last", 6.3), 1, 0)
    assert near(pose_at(recording, "none", 1.0), 0.5, 0)
    assert near(pose_at(recording, "none", 2.3), 1, 0)
    assert near(pose_at(recording, "quick", 1.3), 1, 0)
    moving = [v.stamp for v in recording.velocities("next") if (v.x, v.y) != (0, 0)]
    assert moving[0] >= 1


def test_the_last_velocity_is_zero_when_a_node_is_told_to_end_in_mid_move(
    probe: Workspace | Player, tmp_path: Path
) -> None:
    # The node alone: whoever records must outlive it. A play without processes ends by itself.
    if isinstance(probe, Workspace):
        lines = ("move 1 0", "send self high 0 after 2")
        rebecs = {"a": replace(robot(lines, move_time=20.0), high=("interrupt",))}
        recording = play(probe, tmp_path, rebecs, Clock(until=8, quiet=6))
    else:
        recording = play(probe, tmp_path, {"a": robot(("move 1 0", "delay 20"))}, Clock(until=2))
    *_, moving, last = recording.velocities("a", late=True)
    assert (moving.x, moving.y) != (0, 0)
    assert (last.x, last.y, last.turn) == (0, 0, 0)


def test_a_robot_stops_when_a_body_fails(probe: Workspace, tmp_path: Path) -> None:
    lines = ("move 1 0", "send self low 0 after 2")
    rebecs = {"a": replace(robot(lines, move_time=10.0), low=("divide 1 0",))}
    recording = play(probe, tmp_path, rebecs, Clock(until=8, quiet=4))
    stopped = [v.stamp for v in recording.velocities("a") if v.stamp > 0.5 and v.x == 0]
    assert stopped and 2 <= stopped[0] < 2.5
    assert all(v.x == 0 for v in recording.velocities("a") if v.stamp > stopped[0])


def test_moves_queue_up_when_the_model_is_faster(probe: Workspace, tmp_path: Path) -> None:
    lines = ("move 1 0", "send self low 0")
    rebecs = {"a": replace(robot(lines, move_time=1.0), low=("move 1 0",))}
    recording = play(probe, tmp_path, rebecs, Clock(until=30, quiet=4))
    assert near(pose_at(recording, "a", 9), 2, 0)
