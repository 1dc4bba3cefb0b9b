"""Runs of models by chance, and the movement of the robots in them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from rebsync.checker.lowering import lower
from rebsync.checker.movement import movement_of
from rebsync.checker.movement.ways import Movement
from rebsync.checker.problem import Problem
from rebsync.checker.simulate import by_chance, run
from rebsync.checker.steps import Semantics
from rebsync.checker.telling import Teller
from rebsync.checker.trace import Trace
from rebsync.checker.views import view_of
from rebsync.config import Config, Drive, settings_beside
from rebsync.grammars.cells import parse_cells
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import Analysis, analyse

EXAMPLES = Path(__file__).parents[3] / "examples"


def analysed(text: str) -> Problem:
    """A model without mistakes."""
    source = Source("model.rebeca", text)
    analysis = analyse(parse_model(source).model)
    assert not analysis.errors, analysis.errors
    return Problem(source, analysis)


def run_of(
    problem: Problem, seed: int = 0, steps: int = 100, semantics: Semantics = "tts"
) -> Trace:
    """A run by chance."""
    program, _ = lower(problem.analysis)
    teller = Teller(view_of(program, semantics), problem.source)
    told = tuple(run(teller, by_chance(seed), steps=steps))
    return Trace(problem.source.path, semantics, told)


def moved(
    problem: Problem, trace: Trace, drive: Drive = "holonomic", heading: float = 0.0
) -> Movement:
    """The movement in a run, with cells that the bodies of classes tell."""
    found = movement_of(trace, problem.analysis, Config(drive=drive, heading=heading), {})
    assert found is not None
    return found


def example_run(
    name: str, seed: int, steps: int, semantics: Semantics = "tts", drive: Drive | None = None
) -> tuple[Analysis, Trace, Movement]:
    """A run of an example with its own settings, but for the drive if one is asked for."""
    model = EXAMPLES / name / f"{name}.rebeca"
    problem = analysed(model.read_text(encoding="utf-8"))
    settings, config = settings_beside(str(model))
    cells = parse_cells(settings, config, problem.analysis)
    trace = run_of(problem, seed, steps, semantics)
    chosen = config if drive is None else replace(config, drive=drive)
    found = movement_of(trace, problem.analysis, chosen, cells)
    assert found is not None
    return problem.analysis, trace, found
