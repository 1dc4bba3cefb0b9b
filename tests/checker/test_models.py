"""`models/*.rebeca`: one point of the semantics each, with the figures that were derived by hand.

Among them is every known error of RMC 2.14, and what the floating view gets wrong with `delay`.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import get_args

import pytest

from rebsync.checker.exploration import Unavailable
from rebsync.checker.problem import EngineChoice, Options, Problem
from rebsync.checker.result import Violation
from rebsync.checker.steps import FailureKind, Semantics
from rebsync.checker.verify import verify
from tests.checker.comparing import System, by_reference, findings

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

FOLDER = Path(__file__).parent / "models"
VIEWS: tuple[Semantics, ...] = ("tts", "ftts", "core")


@dataclass(frozen=True)
class Expected:
    """A row of expected.toml."""

    model: str
    view: Semantics
    states: int
    transitions: int
    violations: frozenset[str]


def _rows() -> list[Expected]:
    text = (FOLDER / "expected.toml").read_text(encoding="utf-8")
    return [
        Expected(name, view, row["states"], row["transitions"], frozenset(row["violations"]))
        for name, views in tomllib.loads(text).items()
        for view in VIEWS
        if (row := views.get(view)) is not None
    ]


ROWS = _rows()
rows = pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.model}-{row.view}")


@cache
def read(name: str) -> System:
    """The model with its properties."""
    properties = FOLDER / f"{name}.property"
    return System.of(
        (FOLDER / f"{name}.rebeca").read_text(encoding="utf-8"),
        properties.read_text(encoding="utf-8") if properties.exists() else "",
    )


def test_every_model_has_its_figures() -> None:
    assert {path.stem for path in FOLDER.glob("*.rebeca")} == {row.model for row in ROWS}


def test_every_kind_of_violation_is_among_them() -> None:
    kinds = {violation.split()[0] for row in ROWS for violation in row.violations}
    assert kinds == set(get_args(FailureKind)) | {"property", "deadlock", "zeno"}


@rows
def test_the_reference_agrees(row: Expected) -> None:
    system = read(row.model)
    outcome = by_reference(system, row.view, 1000)
    found = findings(system, outcome)
    assert (found.states, found.transitions) == (row.states, row.transitions)
    kinds = {violation.split()[0] for violation in row.violations} - {"property"}
    assert {v.kind for v in found.failures} == kinds - {"deadlock", "zeno"}
    assert found.deadlock == ("deadlock" in kinds)
    assert outcome.zeno == ("zeno" in kinds)


@pytest.mark.parametrize("engine", ["interpreted", "compiled"])
@rows
def test_verify_agrees(row: Expected, engine: EngineChoice) -> None:
    system = read(row.model)
    problem = Problem(system.source, system.analysis, system.properties)
    try:
        result = verify(problem, Options(row.view, engine))
    except Unavailable as unavailable:
        pytest.skip(f"no compiled engine: {unavailable}")
    assert (result.states, result.transitions) == (row.states, row.transitions)
    assert {_named(violation) for violation in result.violations} == row.violations
    assert result.verdict == ("violated" if row.violations else "satisfied")
    for name, verdict in result.properties:
        assert (verdict == "violated") == (f"property {name}" in row.violations)


def _named(violation: Violation) -> str:
    named = violation.kind in ("assertion", "property", "deadline", "overflow")
    return f"{violation.kind} {violation.name}" if named else violation.kind
