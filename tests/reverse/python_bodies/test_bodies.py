"""Nodes that people could have written in Python become the models that stand beside them.

`python -m tests.reverse.python_bodies` writes them anew.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.cli import main
from tests.reverse.python_bodies.reading import CASES, extracted, said


@pytest.mark.parametrize("case", CASES, ids=lambda c: c.stem)
def test_the_model_is_as_expected(case: Path) -> None:
    model, findings = said(extracted(case))
    assert model == case.with_suffix(".rebeca").read_text(encoding="utf-8")
    assert findings == case.with_suffix(".txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("case", CASES, ids=lambda c: c.stem)
def test_the_model_can_be_checked(case: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = str(case.with_suffix(".rebeca"))
    assert main(["lint", model]) in (0, 1), capsys.readouterr().err
    status = main(["verify", "--engine", "interpreted", "--max-states", "200", model])
    assert status in (0, 3, 4), capsys.readouterr().err
