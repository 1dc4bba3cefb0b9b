"""Edits by hand in roscpp, rclcpp, rospy, rclpy and mixed packages are what they mean.

Here one in three, or in eight, is read and judged, and some go through a sync as well;
`python -m tests.roundtrip.edits` does all of it with all of them, in each dialect.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.roundtrip.edits.steps import all_steps, is_elsewhere, is_listed, is_refused, is_said
from tests.roundtrip.edits.trial import FILES, HERE, Case, cases, made

_EVERY = 8  # of how many edits one goes through all steps


def chosen(file: str) -> list[Case]:
    """Each case of a file in one of its dialects, in turn."""
    by_name: dict[str, list[Case]] = {}
    for case in cases(HERE / file):
        by_name.setdefault(case.name, []).append(case)
    return [of[number % len(of)] for number, of in enumerate(by_name.values())]


CASES = [case for file in FILES for case in chosen(file)[:: 8 if file == "cpp.toml" else 3]]


@pytest.mark.parametrize("case", CASES, ids=str)
def test_edits_are_what_they_mean(
    case: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "cache"))
    trial = made(case, tmp_path / case.example)
    if CASES.index(case) % _EVERY == 0:
        all_steps(trial)
    elif case.listed:
        is_listed(trial)
    elif case.elsewhere:
        is_elsewhere(trial)
    elif case.data.get("refused", False):
        is_refused(trial)
    else:
        is_said(trial)
