"""Edits by hand in roscpp, rclcpp, rospy, rclpy and mixed packages are what they mean.

Here one in eight, or in sixteen, is read and judged, and some go through a sync as well;
`python -m tests.roundtrip.edits` does all of it with all of them, in each dialect.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.roundtrip.edits.drawing import drawn, in_one_dialect
from tests.roundtrip.edits.steps import all_steps, is_judged
from tests.roundtrip.edits.trial import FILES, Case, made

_EVERY = 12  # of how many edits one goes through all steps


def drawn_cases(file: str) -> list[Case]:
    """One in eight of the cases of a file, or in sixteen of the longest one."""
    every = 16 if file == "cpp.toml" else 8
    return [case for case in in_one_dialect(file) if drawn("tested", case.name, every) == 0]


CASES = [case for file in FILES for case in drawn_cases(file)]


@pytest.mark.parametrize("case", CASES, ids=str)
def test_edits_are_what_they_mean(
    case: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "cache"))
    trial = made(case, tmp_path / case.example)
    if drawn("all steps", case.name, _EVERY) == 0:
        all_steps(trial)
    else:
        is_judged(trial)
