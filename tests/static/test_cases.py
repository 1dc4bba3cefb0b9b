"""Every rule of the analysis on models that say beside the code what must be reported."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from rebsync.codes import NAMES, ROBOTIC, STRUCTURE, TYPES, WARNINGS
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from rebsync.static import analyse

CASES = Path(__file__).parent / "cases"
HEADING = re.compile(r"^// case: (?P<title>.*)$", re.MULTILINE)
EXPECTATION = re.compile(
    r"// (?P<severity>[EWN]): (?P<code>RS\d+) (?P<message>.*?)(?=\s*// [EWN]: |$)"
)
SEVERITY = {"error": "E", "warning": "W", "note": "N"}


@dataclass(frozen=True)
class Case:
    title: str
    path: Path
    line: int
    text: str


def read_cases(path: Path) -> Iterator[Case]:
    """The models of one file; `// case: title` begins each."""
    text = path.read_text(encoding="utf-8")
    headings = list(HEADING.finditer(text))
    assert headings and headings[0].start() == 0, f"{path.name} does not begin with a case"
    ends = [h.start() for h in headings[1:]] + [len(text)]
    for heading, end in zip(headings, ends, strict=True):
        line = text.count("\n", 0, heading.start())
        yield Case(heading["title"], path, line, text[heading.start() : end])


ALL = [case for path in sorted(CASES.glob("*.rebeca")) for case in read_cases(path)]


def expected(case: Case) -> list[tuple[int, str, str, str]]:
    """(line, severity, code, beginning of the message) of each comment."""
    return [
        (number, m["severity"], m["code"], m["message"])
        for number, line in enumerate(case.text.split("\n"), 1)
        for m in EXPECTATION.finditer(line)
    ]


def reported(case: Case) -> list[tuple[int, str, str, str]]:
    source = Source(str(case.path), case.text)
    parsed = parse_model(source)
    assert not parsed.diagnostics, f"{case.title}: {parsed.diagnostics}"
    analysis = analyse(parsed.model, fragment="(fragment)" in case.title)
    return [
        (source.position(d.span.start).line, SEVERITY[d.severity.value], d.code, d.message)
        for d in analysis.diagnostics
    ]


@pytest.mark.parametrize("case", ALL, ids=lambda case: f"{case.path.stem}: {case.title}")
def test_case(case: Case) -> None:
    wanted, found = expected(case), reported(case)
    assert bool(wanted) != ("// clean" in case.text), "say what is reported, or // clean"
    missing = [w for w in wanted if not any(_fits(w, f) for f in found)]
    surplus = [f for f in found if not any(_fits(w, f) for w in wanted)]
    shown = [f"{case.path.name}:{case.line + n}: {s}: {c} {m}" for n, s, c, m in surplus]
    assert not surplus, "not expected:\n" + "\n".join(shown)
    assert not missing, f"not reported: {missing}"
    assert len(found) == len(wanted), f"reported twice: {Counter(found).most_common(2)}"


def _fits(wanted: tuple[int, str, str, str], found: tuple[int, str, str, str]) -> bool:
    return wanted[:3] == found[:3] and found[3].startswith(wanted[3])


def test_every_code_has_a_case() -> None:
    codes = {code for table in (NAMES, TYPES, STRUCTURE, WARNINGS, ROBOTIC) for code in table}
    seen = {code for case in ALL for _, _, code, _ in expected(case)}
    # No text of a choice with one option reaches the analysis: test_trees.py builds the tree.
    assert codes - seen == {"RS420"}


def test_a_wrong_expectation_is_noticed() -> None:
    case = Case("none", CASES / "none.rebeca", 0, "main { } // E: RS203 unknown")
    assert reported(case) != expected(case)
