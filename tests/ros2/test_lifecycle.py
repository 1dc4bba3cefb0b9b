"""Nodes with a life cycle on the stub of rclcpp: what they do inactive, and again."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.config import Config
from tests.forward.compiling import CASES, generated, written
from tests.ros1.recording import Recording
from tests.ros2.building import build_driver, complaints, make_messages
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
from tests.ros2.running import run

__all__ = [
    "test_an_inactive_robot_stands_and_then_drives_what_is_left",
    "test_messages_wait_and_what_is_too_late_is_told",
    "test_the_body_goes_on_as_much_later",
    "test_the_other_one_goes_on",
]
_CONFIG = Config(target="ros2-cpp", lifecycle=True)


@pytest.fixture(scope="module")
def package(headers: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("lifecycle")
    package = written(generated(MODEL, "pair", _CONFIG), directory, "pair", _CONFIG)
    make_messages([package], headers)
    return package


@pytest.fixture(scope="module")
def driver(package: Path, headers: Path) -> Path:
    """With the thread sanitizer: what it finds ends the run."""
    return build_driver(package, headers, package.parent / "build", ["-fsanitize=thread", "-g"])


@pytest.fixture(scope="module")
def paused(package: Path, driver: Path) -> Recording:
    """The robot is inactive in mid-move."""
    changes = {"r": [(3.5, "deactivate"), (8.5, "activate")]}
    return run(package, driver, package.parent, 20, changes=changes)


def test_a_rebec_is_made_again_after_cleanup(package: Path, driver: Path) -> None:
    """The state is new, and it joins the time of the others."""
    names = ("deactivate", "cleanup", "configure", "activate")
    changes = {"r": list(zip((3.5, 4.5, 6.5, 7.5), names, strict=True))}
    recording = run(package, driver, package.parent, 20, changes=changes)
    (report,) = recording.reports("restarted")
    assert (report.rebec, report.facts) == ("r", "serves from 8 on, what came before is lost")
    served = [b for b in recording.served if b.rebec == "r" and b.start >= 8]
    assert (served[0].server, served[0].state["n"]) == ("constructor", 0)
    assert next(b.start for b in served if b.server == "go") == 9


def test_time_0_is_when_the_last_one_is_active(package: Path, driver: Path) -> None:
    changes = {
        "r": [(0.1, "configure"), (0.2, "activate")],
        "t": [(0.1, "configure"), (5.0, "activate")],
    }
    recording = run(package, driver, package.parent, 8, changes=changes, arguments=BY_HAND)
    first = next(b for b in recording.bodies("r") if b.server == "go")
    assert first.start == 1
    assert first.stamp == pytest.approx(5, abs=0.2)  # when it ends
    assert not recording.reports("restarted")


def test_who_is_inactive_at_time_0_loses_nothing(package: Path, driver: Path) -> None:
    recording = run(package, driver, package.parent, 9, changes=BEFORE_TIME_0, arguments=BY_HAND)
    check_what_waits_since_before_time_0(recording)


def test_a_node_that_is_shut_down_stands(package: Path, driver: Path) -> None:
    recording = run(package, driver, package.parent, 8, changes={"r": [(3.5, "shutdown")]})
    *_, last = recording.velocities("r")
    assert last.x == 0
    assert last.stamp == pytest.approx(3.5, abs=0.2)
    assert not [b for b in recording.bodies("r") if b.stamp > 3.5]


def test_cases_compile(headers: Path, tmp_path: Path) -> None:
    packages = []
    for name in ("inheritance", "sensors"):
        text = (CASES / f"{name}.rebeca").read_text(encoding="utf-8")
        packages.append(written(generated(text, name, _CONFIG), tmp_path, name, _CONFIG))
    make_messages(packages, headers)
    assert [text for package in packages for text in complaints(package, headers)] == []
