"""How much of each body is exact: counted from findings that are made up."""

from __future__ import annotations

import json

from rebsync import model as m
from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.recovery import Extracted
from rebsync.reverse.report import as_json, as_text, diagnostics, grade_of, summary
from rebsync.source import Source, Span

SOURCE = Source("a.cpp", "x;\ny;\nz;\n")
OTHER = Source("b.cpp", "")
BODIES = (("Talker.tick", 3), ("Talker.heard", 5))


def finding(grade: Grade, within: str, start: int = 0, source: Source = SOURCE) -> Finding:
    return Finding(grade, source, Span(start, start + 1), "no word for this", "add one", within)


def extracted(*findings: Finding) -> Extracted:
    return Extracted(m.Model((), (), None), findings, BODIES)


MIXED = extracted(
    finding(Grade.UNREADABLE, "Talker.heard", 6),
    finding(Grade.APPROXIMATED, "Talker.heard", 3),
    finding(Grade.UNREADABLE, "", 0, OTHER),
)


def test_what_is_exact() -> None:
    assert as_text(extracted()) == (
        "Talker.tick   3 of 3 statements exact\n"
        "Talker.heard  5 of 5 statements exact\n"
        "all           8 of 8 statements exact\n"
    )
    assert grade_of(extracted()) == "exact"


def test_what_is_not_exact() -> None:
    assert as_text(MIXED) == (
        "Talker.tick   3 of 3 statements exact\n"
        "Talker.heard  3 of 5 statements exact, 1 over-approximated, 1 unreadable\n"
        "elsewhere     1 unreadable\n"
        "all           6 of 8 statements exact, 1 over-approximated, 1 unreadable\n"
    )
    assert summary(MIXED) == "6 of 8 statements exact, 1 over-approximated, 1 unreadable"


def test_the_worst_grade_is_that_of_all() -> None:
    assert grade_of(MIXED) == "unreadable"
    assert grade_of(extracted(finding(Grade.APPROXIMATED, ""))) == "over-approximated"


def test_the_report_as_json() -> None:
    found = json.loads(as_json(MIXED))
    assert found["grade"] == "unreadable"
    assert found["bodies"][1] == {
        "name": "Talker.heard",
        "statements": 5,
        "over_approximated": 1,
        "assumed": 0,
        "unreadable": 1,
    }
    assert found["findings"][0] == {
        "grade": "unreadable",
        "file": "a.cpp",
        "line": 3,
        "column": 1,
        "within": "Talker.heard",
        "text": "z",
        "why": "no word for this",
        "hint": "add one",
    }


def test_findings_stand_in_the_order_of_the_text() -> None:
    first, second = diagnostics(MIXED.findings)
    assert [d.code for d in first.diagnostics] == ["RS942", "RS941"]
    assert second.source.path == "b.cpp"


def test_what_is_found_twice_is_listed_once() -> None:
    twice = extracted(*MIXED.findings, *MIXED.findings[:1])
    assert diagnostics(twice.findings) == diagnostics(MIXED.findings)
    assert json.loads(as_json(twice))["findings"] == json.loads(as_json(MIXED))["findings"]
    assert "Talker.heard  2 of 5 statements exact" in as_text(twice)
