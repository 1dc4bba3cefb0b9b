"""The drive of rclpy packages, in one process."""

from __future__ import annotations

import threading
import time
from pathlib import Path
from typing import Any, cast

import pytest

from tests.ros1.probes import Player, play
from tests.ros1.run import Clock
from tests.ros1.test_drive import (
    near,
    pose_at,
    robot,
    test_a_differential_robot_never_slides,
    test_a_differential_robot_turns_first_and_the_short_way,
    test_a_holonomic_robot_moves_straight_and_evenly,
    test_a_move_takes_the_time_of_the_next_delay_or_the_last_or_a_parameter,
    test_a_robot_stops_when_a_body_fails,
    test_every_move_ends_in_its_cell,
    test_moves_queue_up_when_the_model_is_faster,
    test_the_last_velocity_is_zero_when_a_node_is_told_to_end_in_mid_move,
    test_velocities_come_at_ten_hertz_and_end_with_a_stop,
    tour,
)
from tests.ros2py.messages import Message
from tests.ros2py.world import Publisher

_PATIENCE = 5.0  # s of the real clock

__all__ = [
    "test_a_differential_robot_never_slides",
    "test_a_differential_robot_turns_first_and_the_short_way",
    "test_a_holonomic_robot_moves_straight_and_evenly",
    "test_a_move_takes_the_time_of_the_next_delay_or_the_last_or_a_parameter",
    "test_a_robot_stops_when_a_body_fails",
    "test_every_move_ends_in_its_cell",
    "test_moves_queue_up_when_the_model_is_faster",
    "test_the_last_velocity_is_zero_when_a_node_is_told_to_end_in_mid_move",
    "test_velocities_come_at_ten_hertz_and_end_with_a_stop",
    "tour",
]


def test_a_robot_whose_velocity_does_not_go_out_stops(
    probe: Player, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    publish, told = Publisher.publish, []

    def fails_once(publisher: Publisher, message: Message) -> None:
        if publisher.topic_name == "/a/cmd_vel" and cast(Any, message).linear.x != 0:
            told.append(message)
            if len(told) == 5:
                raise RuntimeError("no way out")
        publish(publisher, message)

    monkeypatch.setattr(Publisher, "publish", fails_once)
    rebecs = {"a": robot(("move 1 0",), move_time=4.0)}
    recording = play(probe, tmp_path, rebecs, Clock(until=8, quiet=8))
    assert [line.text for line in recording.log] == ["drive: a.cmd_vel (no way out)"]
    *_, last = (v for v in recording.velocities("a") if v.stamp < 1)
    assert len(told) == 5
    assert last.x == 0


def test_the_first_move_is_kept_however_late_the_drive_starts(
    probe: Player, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    start, moved = threading.Thread.start, []

    def starts_late(thread: threading.Thread) -> None:
        run = cast(Any, thread)._target
        drive: Any = getattr(run, "__self__", None)
        if type(drive).__name__ != "Drive":
            return start(thread)

        def late() -> None:
            limit = time.monotonic() + _PATIENCE
            while not drive._driving and time.monotonic() < limit:
                time.sleep(0.001)
            moved.append(drive._driving)
            run()

        cast(Any, thread)._target = late
        return start(thread)

    monkeypatch.setattr(threading.Thread, "start", starts_late)
    rebecs = {"a": robot(("move 1 0", "delay 4"))}
    recording = play(probe, tmp_path, rebecs, Clock(until=8, quiet=8))
    assert moved == [True]
    assert near(pose_at(recording, "a", 4.1, 0), 1, 0)
