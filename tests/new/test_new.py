"""`cases/NAME.toml` becomes `cases/NAME.rebeca`, or has the mistakes that its comments name.

`python -m tests.new.test_new` writes the expected models anew.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rebsync.concept import parse_concept
from rebsync.diagnostics import Findings, RebsyncError, Severity
from rebsync.files import read_source
from rebsync.forward.skeleton import skeleton
from rebsync.grammars.formatting import format_text
from rebsync.lint import lint
from rebsync.source import Source

FOLDER = Path(__file__).parent / "cases"
MISTAKE = re.compile(r"# (RS\d+) ([^#]*[^# ])")
WRONG = [case for case in sorted(FOLDER.glob("*.toml")) if MISTAKE.search(case.read_text())]
RIGHT = [case for case in sorted(FOLDER.glob("*.toml")) if case not in WRONG]


def model_of(case: Path) -> str:
    """The skeleton of a case."""
    return skeleton(parse_concept(read_source(str(case))))


@pytest.mark.parametrize("case", RIGHT, ids=lambda case: case.stem)
def test_skeleton(case: Path) -> None:
    text = model_of(case)
    assert text == case.with_suffix(".rebeca").read_text(encoding="utf-8")
    assert format_text(text) == text


@pytest.mark.parametrize("case", RIGHT, ids=lambda case: case.stem)
def test_a_skeleton_lints_without_errors_and_without_robotic_warnings(case: Path) -> None:
    found = lint(Source("skeleton.rebeca", model_of(case))).diagnostics
    assert not [d for d in found if d.severity is Severity.ERROR or d.code.startswith("RS6")]


@pytest.mark.parametrize("case", WRONG, ids=lambda case: case.stem)
def test_mistakes(case: Path) -> None:
    source = read_source(str(case))
    wanted = sorted(
        (number, *match.groups())
        for number, line in enumerate(source.text.splitlines(), start=1)
        for match in MISTAKE.finditer(line)
    )
    with pytest.raises(RebsyncError) as caught:
        parse_concept(source)
    found = sorted(_told(caught.value.findings[0]))
    assert [f[:2] for f in found] == [w[:2] for w in wanted], found
    for seen, expected in zip(found, wanted, strict=True):
        assert seen[2].startswith(str(expected[2])), (seen, expected)


def _told(findings: Findings) -> list[tuple[int, str, str]]:
    source = findings.source
    return [(source.position(d.span.start).line, d.code, d.message) for d in findings.diagnostics]


if __name__ == "__main__":
    for each in RIGHT:
        each.with_suffix(".rebeca").write_text(model_of(each), encoding="utf-8")
