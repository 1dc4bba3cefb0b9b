"""A program may be installed by another name, if launch files start it by that."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.roundtrip.verdict.drift import Verdict
from tests.roundtrip.python.packages import checked, made, told

_SETUP = ("setup.py", '"r1_node = ', '"robot_node = ')
_LAUNCH = ("running_example.launch.py", 'executable="r1_node"', 'executable="robot_node"')


def _renamed(folder: Path, *edits: tuple[str, str, str]) -> Path:
    root = made("running_example", "ros2-py", folder)
    for name, old, new in edits:
        (path,) = (p for p in root.rglob(name) if ".rebsync" not in p.parts)
        text = path.read_text(encoding="utf-8")
        assert old in text
        path.write_text(text.replace(old, new), encoding="utf-8")
    return root


def test_a_program_that_is_renamed_at_both_ends_is_in_step(tmp_path: Path) -> None:
    found = checked(_renamed(tmp_path, _SETUP, _LAUNCH))
    assert told(found) == []
    assert found.drift is None or found.drift.verdict is Verdict.IN_STEP


@pytest.mark.parametrize("edit", [_SETUP, _LAUNCH], ids=["setup", "launch"])
def test_a_program_that_is_renamed_at_one_end_is_told(
    edit: tuple[str, str, str], tmp_path: Path
) -> None:
    drift = checked(_renamed(tmp_path, edit)).drift
    assert drift is not None
    assert drift.verdict is not Verdict.IN_STEP
