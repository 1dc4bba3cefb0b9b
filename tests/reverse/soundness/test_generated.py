"""What people write into generated Python, the recovered model does, or the place is listed."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.reverse.python.generated import loops
from tests.reverse.soundness.generated import tallied


def test_models_do_what_edited_code_does(tmp_path: Path) -> None:
    tally = tallied(tmp_path, range(4))
    assert tally.refused == []
    assert tally.unsound == []
    assert tally.exact > 100


def test_arrays_that_a_loop_stores_are_found_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(loops, "_assert_kept", lambda *_: None)
    assert tallied(tmp_path, [27]).unsound
