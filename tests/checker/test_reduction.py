"""`reduction/*.rebeca`: models in which one order of steps alone would tell something else."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.checker.problem import EngineChoice, Options, Problem
from rebsync.checker.verify import verify
from tests.checker.comparing import System

MODELS = sorted((Path(__file__).parent / "reduction").glob("*.rebeca"))


@pytest.mark.parametrize("model", MODELS, ids=lambda path: path.stem)
@pytest.mark.parametrize("engine", ["interpreted", "compiled"])
def test_a_property_is_violated_with_and_without_reduction(
    model: Path, engine: EngineChoice
) -> None:
    texts = (path.read_text(encoding="utf-8") for path in (model, model.with_suffix(".property")))
    system = System.of(*texts)
    problem = Problem(system.source, system.analysis, system.properties)
    for reduce in (False, True):
        result = verify(problem, Options(None, engine, reduce=reduce))
        assert result.properties == (("never", "violated"),)
