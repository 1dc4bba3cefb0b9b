"""A few histories; `python -m tests.roundtrip.histories --count 1000` draws many."""

from __future__ import annotations

import pytest

from tests.roundtrip.histories.history import history


@pytest.mark.parametrize("seed", range(6))
def test_laws_hold_after_every_sync(seed: int) -> None:
    done = history(seed, 2, ("hello", "experiment1", "experiment3"))
    assert [(step.edits, step.broken) for step in done.steps if step.broken] == []
