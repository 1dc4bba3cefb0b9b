"""Small packages that people could have written, as models: `cases/NAME` with what comes out.

`python -m tests.reverse.nodes` writes `expected.rebeca` and `findings.txt` of each case anew.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rebsync.cli import main
from rebsync.printing import print_model
from rebsync.reverse.files.reading import chosen
from rebsync.reverse.recovery import extract
from tests.reverse.nodes.cases import CASES, extracted, said

CODE = (".cpp", ".h", ".hpp")


@pytest.mark.parametrize("case", CASES, ids=lambda c: c.name)
def test_the_model_is_as_expected(case: Path) -> None:
    model, findings = said(extracted(case))
    assert model == (case / "expected.rebeca").read_text(encoding="utf-8")
    assert findings == (case / "findings.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["compared", "computed", "handed_lambda", "held"])
def test_blank_lines_before_all_else_change_nothing(name: str) -> None:
    (case,) = (c for c in CASES if c.name == name)
    files = chosen(str(case / "package")).files
    shifted = {
        path: replace(source, text=f"\n \n\n{source.text}") if path.endswith(CODE) else source
        for path, source in files.items()
    }
    found, before = extract(shifted), extract(files)
    assert print_model(found.model) == print_model(before.model)
    assert [(f.grade, f.why) for f in found.findings] == [(f.grade, f.why) for f in before.findings]


@pytest.mark.parametrize("case", CASES, ids=lambda c: c.name)
def test_the_model_can_be_checked(case: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = str(case / "expected.rebeca")
    assert main(["lint", model]) in (0, 1), capsys.readouterr().err
    status = main(["verify", "--engine", "interpreted", "--max-states", "200", model])
    assert status in (0, 3, 4), capsys.readouterr().err


def test_every_case_has_all_its_files() -> None:
    assert len(CASES) >= 12
    for case in CASES:
        assert (case / "package" / "package.xml").is_file(), case.name
