"""The examples hold, or are violated, as their pages say; states and transitions are pinned."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from rebsync.checker.problem import EngineChoice, Options
from rebsync.checker.verify import verify
from rebsync.cli.problem import read_problem
from tests.cli.run import ROOT


@dataclass(frozen=True)
class Expected:
    """Counts of the exact view, and the properties that are violated with the time when."""

    name: str
    states: int
    transitions: int
    violated: tuple[tuple[str, int], ...] = ()


EXAMPLES = (
    Expected("experiment1", 89, 89),
    Expected("experiment1_unsafe", 961, 961, (("Fuel_Guaranteed", 22),)),
    Expected("experiment2", 102, 134),
    Expected(
        "experiment2_unsafe", 102, 144, (("Collision_Avoidance", 4), ("Left_Before_Entered", 5))
    ),
    Expected("experiment3", 225, 344),
    Expected("experiment3_unsafe", 265, 394, (("Safety", 0),)),
    Expected("running_example", 69_040, 157_290),
    Expected("warehouse", 240_863, 973_976),
)
SMALL = tuple(e for e in EXAMPLES if e.states < 1000)


@pytest.mark.parametrize("expected", EXAMPLES, ids=lambda e: e.name)
def test_compiled(expected: Expected) -> None:
    _check(expected, "compiled")


@pytest.mark.parametrize("expected", SMALL, ids=lambda e: e.name)
def test_interpreted(expected: Expected) -> None:
    _check(expected, "interpreted")


def _check(expected: Expected, engine: EngineChoice) -> None:
    model = ROOT / "examples" / expected.name / f"{expected.name}.rebeca"
    problem = read_problem(str(model), None)
    allowed = frozenset(["deadlock"])
    result = verify(problem, Options(semantics="tts", engine=engine, allowed=allowed))
    assert (result.states, result.transitions) == (expected.states, expected.transitions)
    assert result.verdict == ("violated" if expected.violated else "satisfied")
    violated = tuple((v.name, v.trace.steps[-1].until) for v in result.violations)
    assert violated == expected.violated
    named = {name for name, _ in expected.violated}
    for name, verdict in result.properties:
        assert verdict == ("violated" if name in named else "satisfied")
