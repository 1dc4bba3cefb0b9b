"""What `rebsync verify` reduces by itself, against the full search, on drawn systems."""

from __future__ import annotations

from collections import Counter
from unittest import mock

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rebsync.checker import reducing
from rebsync.checker.exploration import Limits
from rebsync.checker.problem import Options, Problem
from rebsync.checker.result import Result
from rebsync.checker.steps import Semantics
from rebsync.checker.verify import verify
from tests.checker.comparing import System
from tests.checker.draw_networks import networks
from tests.checker.draw_systems import EQUAL, Drawn, systems

LIMITS = Limits(states=1500)
_FEW = settings(max_examples=max(6, settings().max_examples // 5))
_DRAWN = st.one_of(networks(), networks(delays=False), systems(EQUAL))


@pytest.mark.parametrize("view", ["tts", "ftts"])
@_FEW
@given(drawn=_DRAWN)
def test_verdicts_and_lengths_of_shortest_runs_are_those_of_the_full_search(
    view: Semantics, drawn: Drawn
) -> None:
    system = System.of(drawn.model, drawn.properties)
    problem = Problem(system.source, system.analysis, system.properties)
    full = verify(problem, Options(view, "interpreted", LIMITS))
    assume(full.reason is None)
    with mock.patch.multiple(reducing, TRIAL=5, FURTHER=0):
        reduced = verify(problem, Options(view, "interpreted", LIMITS, auto_reduce=True))
    assert reduced.states <= full.states
    assert (reduced.verdict, reduced.reason) == (full.verdict, full.reason)
    assert reduced.properties == full.properties
    assert _shortest(reduced) == _shortest(full)
    if not any("counted once" in caveat for caveat in reduced.caveats):
        assert _runs(reduced) == _runs(full)


def _shortest(result: Result) -> dict[str, int]:
    """By kinds of violations how long the shortest run to one is."""
    found: dict[str, int] = {}
    for violation in result.violations:
        length = len(violation.trace.steps)
        if violation.trace.loop is None:  # a run round a cycle has no shortest
            found[violation.kind] = min(length, found.get(violation.kind, length))
    return found


def _runs(result: Result) -> Counter[tuple[str, str, int]]:
    return Counter((v.kind, v.name, len(v.trace.steps)) for v in result.violations)
