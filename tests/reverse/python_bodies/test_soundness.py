"""Whatever a callback in Python does, the recovered model can do too, or the place is listed."""

from __future__ import annotations

import os

import pytest

from rebsync.reverse.python.nodes import body_system
from tests.reverse.python_bodies.trial import tallied

DRAWN = int(os.environ.get("REBSYNC_DRAWN_NODES", "16"))


def test_models_can_do_what_the_code_does() -> None:
    tally = tallied(range(DRAWN))
    assert tally.refused == []
    assert tally.unsound == []
    assert 2 * tally.exact > tally.unreadable > 0


def test_numbers_that_leave_the_int_are_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(body_system, "proved_otherwise", lambda *_: False)
    assert tallied(range(2, 8)).unsound
