"""What a run of a node shows is never proved impossible of the model that was read from it.

`python -m tests.reverse.native` writes the verdicts of all cases anew.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.reverse.native.closing import Case, Input, cases, verdicts
from tests.reverse.native.roscpp_run import run_all
from tests.reverse.native.rospy_play import played

IN_CPP = [c for c in cases() if c.node.endswith(".cpp")]
IN_PYTHON = [c for c in cases() if c.node.endswith(".py")]


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[Input]]:
    """What the nodes in C++ publish."""
    if shutil.which("g++") is None:
        pytest.skip("g++ is not installed")
    return run_all(tmp_path_factory.mktemp("native"), IN_CPP)


@pytest.mark.parametrize("case", IN_CPP, ids=lambda c: c.name)
def test_a_run_in_cpp_shows_what_the_case_says(case: Case, runs: dict[str, list[Input]]) -> None:
    _is_shown(case, runs[case.folder.name])


@pytest.mark.parametrize("case", IN_PYTHON, ids=lambda c: c.name)
def test_a_run_in_python_shows_what_the_case_says(case: Case) -> None:
    _is_shown(case, played(case.folder / case.node, case.inputs))


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
