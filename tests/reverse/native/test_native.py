"""What a run of a node shows is never proved impossible of the model that was read from it.

`python -m tests.reverse.native` writes the verdicts of all cases anew.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.reverse.native import rclcpp_run, rclpy_play, roscpp_run, rospy_play
from tests.reverse.native.closing import Case, cases, verdicts
from tests.reverse.native.ros1 import Input

# The first test of a run compiles the nodes of all cases, beside others that compile.
pytestmark = pytest.mark.timeout(900)

IN_CPP = [c for c in cases() if c.node.endswith(".cpp")]
IN_PYTHON = [c for c in cases() if c.node.endswith(".py")]
RUNNERS = {"node.cpp": roscpp_run.run_all, "rclcpp.cpp": rclcpp_run.run_all}
PLAYS = {"node.py": rospy_play.played, "rclpy.py": rclpy_play.played}


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[Input]]:
    """What the nodes in C++ publish, by the names of their cases."""
    if shutil.which("g++") is None:
        pytest.skip("g++ is not installed")
    found: dict[str, list[Input]] = {}
    for node, run_all in RUNNERS.items():
        of_library = [case for case in IN_CPP if case.node == node]
        shown = run_all(tmp_path_factory.mktemp("native"), of_library)
        found |= {case.name: shown[case.folder.name] for case in of_library}
    return found


@pytest.mark.parametrize("case", IN_CPP, ids=lambda c: c.name)
def test_a_run_in_cpp_shows_what_the_case_says(case: Case, runs: dict[str, list[Input]]) -> None:
    _is_shown(case, runs[case.name])


@pytest.mark.parametrize("case", IN_PYTHON, ids=lambda c: c.name)
def test_a_run_in_python_shows_what_the_case_says(case: Case) -> None:
    _is_shown(case, PLAYS[case.node](case.folder / case.node, case.inputs))


def _is_shown(case: Case, sent: list[Input]) -> None:
    values = [value for topic, value in sent if topic == "out"]
    assert case.shows in values
    assert case.never not in values


@pytest.mark.parametrize("case", cases(), ids=lambda c: c.name)
def test_what_a_run_shows_is_not_proved_impossible(case: Case, tmp_path: Path) -> None:
    shown, never = verdicts(case, tmp_path)
    assert shown != "satisfied"
    assert never != "violated"
    assert shown == case.verdict
