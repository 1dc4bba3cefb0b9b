"""Nodes of rclpy with a life cycle, in one process: what they do inactive, and again."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import generated, written
from tests.ros1.recording import Recording
from tests.ros2.pausing import (
    BEFORE_TIME_0,
    BY_HAND,
    MODEL,
    check_what_waits_since_before_time_0,
    test_an_inactive_robot_stands_and_then_drives_what_is_left,
    test_messages_wait_and_what_is_too_late_is_told,
    test_the_body_goes_on_as_much_later,
    test_the_other_one_goes_on,
)
from tests.ros2py.playing import play

__all__ = [
    "test_an_inactive_robot_stands_and_then_drives_what_is_left",
    "test_messages_wait_and_what_is_too_late_is_told",
    "test_the_body_goes_on_as_much_later",
    "test_the_other_one_goes_on",
]


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory, config = tmp_path_factory.mktemp("life"), Config(target="ros2-py", lifecycle=True)
    return written(generated(MODEL, "pair", config), directory, "pair", config)


@pytest.fixture(scope="module")
def paused(package: Path) -> Recording:
    """The robot is inactive in mid-move."""
    return play(package, 20, {"r": [(3.5, "deactivate"), (8.5, "activate")]})


def test_a_rebec_is_made_again_after_cleanup(package: Path) -> None:
    """The state is new, and it joins the time of the others."""
    names = ("deactivate", "cleanup", "configure", "activate")
    changes = list(zip((3.5, 4.5, 6.5, 7.5), names, strict=True))
    recording = play(package, 20, {"r": changes})
    (report,) = recording.reports("restarted")
    assert (report.rebec, report.facts) == ("r", "serves from 8 on, what came before is lost")
    served = [b for b in recording.served if b.rebec == "r" and b.start >= 8]
    assert (served[0].server, served[0].state["n"]) == ("constructor", 0)
    assert next(b.start for b in served if b.server == "go") == 9


def test_who_is_inactive_at_time_0_loses_nothing(package: Path) -> None:
    check_what_waits_since_before_time_0(play(package, 9, BEFORE_TIME_0, BY_HAND))


def test_a_node_that_is_shut_down_stands(package: Path) -> None:
    recording = play(package, 8, {"r": [(3.5, "shutdown")]})
    *_, last = recording.velocities("r")
    assert last.x == 0
    assert last.stamp == pytest.approx(3.5, abs=0.2)
