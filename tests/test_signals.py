"""What one test does to signals the next does not see: played nodes end by ignoring them."""

from __future__ import annotations

import signal

import pytest

_ENDING = (signal.SIGINT, signal.SIGTERM)


@pytest.mark.parametrize("number", _ENDING, ids=lambda number: number.name)
def test_a_test_may_have_signals_ignored(number: signal.Signals) -> None:
    signal.signal(number, signal.SIG_IGN)
    assert signal.getsignal(number) is signal.SIG_IGN


@pytest.mark.parametrize("number", _ENDING, ids=lambda number: number.name)
def test_the_next_test_has_them_act(number: signal.Signals) -> None:
    assert signal.getsignal(number) is not signal.SIG_IGN
