"""Findings as text, JSON, SARIF and GitHub annotations."""

from __future__ import annotations

import io
import json
from typing import Any

import jsonschema  # type: ignore[import-untyped]
import pytest

from rebsync.diagnostics import Diagnostic, Edit, Findings, Severity
from rebsync.report import print_report, report, summary
from rebsync.report_text import Piece, coloured
from rebsync.source import NOWHERE, Source, Span

TEXT = "reactiveclass A(2) {\n\tknowrebecs { B b; }\n}\n"
AT = TEXT.index("knowrebecs")
SLIP = Diagnostic(
    "RS104",
    Span(AT, AT + 10),
    '"knowrebecs" is not a keyword',
    'did you mean "knownrebecs"?',
    edits=(Edit(Span(AT, AT + 10), "knownrebecs"),),
    related=((Span(14, 15), "in this class"),),
)
WARNING = Diagnostic(
    "RS502", Span(AT + 15, AT + 16), "`b` is never used", severity=Severity.WARNING
)
MISSING = Findings(
    Source("dir, with: signs/b.rebeca", ""), (Diagnostic("RS801", NOWHERE, "no such file"),)
)
FINDINGS = [Findings(Source("a.rebeca", TEXT), (SLIP, WARNING)), MISSING]


def one(text: str, start: int, end: int, message: str = "here") -> str:
    """The report of a single finding in a text."""
    found = Diagnostic("RS101", Span(start, end), message)
    return report([Findings(Source("x", text), (found,))])


def test_text() -> None:
    assert report(FINDINGS) == (
        'a.rebeca:2:2: RS104 "knowrebecs" is not a keyword\n'
        "  \tknowrebecs { B b; }\n"
        "  \t^~~~~~~~~~\n"
        'hint: did you mean "knownrebecs"?\n'
        "a.rebeca:1:15: note: in this class\n"
        "  reactiveclass A(2) {\n"
        "                ^\n"
        "a.rebeca:2:17: RS502 `b` is never used\n"
        "  \tknowrebecs { B b; }\n"
        "  \t               ^\n"
        "dir, with: signs/b.rebeca: RS801 no such file\n"
    )


@pytest.mark.parametrize(
    ("text", "start", "end", "lines"),
    [
        ("", 0, 0, ["x:1:1: RS101 here", "  ", "  ^"]),
        ("ab\n", 3, 3, ["x:2:1: RS101 here", "  ", "  ^"]),
        ("ab\ncd", 1, 5, ["x:1:2: RS101 here", "  ab", "   ^"]),
        ("a\r\nb\r\n", 3, 4, ["x:2:1: RS101 here", "  b", "  ^"]),
        ("日本 x", 3, 4, ["x:1:4: RS101 here", "  日本 x", "       ^"]),
        ("日本", 0, 2, ["x:1:1: RS101 here", "  日本", "  ^~~~"]),
        ("\x1b[31m", 0, 1, ["x:1:1: RS101 here", "  \\x1b[31m", "  ^~~~"]),
    ],
    ids=["empty", "end", "two lines", "crlf", "before wide", "wide", "control"],
)
def test_the_caret_is_below_the_place(text: str, start: int, end: int, lines: list[str]) -> None:
    assert one(text, start, end).split("\n") == [*lines, ""]


def test_a_very_long_line_is_clipped_around_the_place() -> None:
    _, excerpt, caret, _ = one("a" * 5000 + "!" + "b" * 5000, 5000, 5001).split("\n")
    assert len(excerpt) < 140
    assert excerpt[caret.index("^")] == "!"


def test_json() -> None:
    whole = json.loads(report(FINDINGS, "json"))
    assert whole["version"] == 1
    first, second, third = whole["findings"]
    assert first == {
        "code": "RS104",
        "title": "a keyword or section name that is misspelled",
        "severity": "error",
        "message": '"knowrebecs" is not a keyword',
        "hint": 'did you mean "knownrebecs"?',
        "path": "a.rebeca",
        "region": {"startLine": 2, "startColumn": 2, "endLine": 2, "endColumn": 12},
        "fix": [
            {
                "region": {"startLine": 2, "startColumn": 2, "endLine": 2, "endColumn": 12},
                "text": "knownrebecs",
            }
        ],
        "related": [
            {
                "region": {"startLine": 1, "startColumn": 15, "endLine": 1, "endColumn": 16},
                "message": "in this class",
            }
        ],
    }
    assert second["severity"] == "warning"
    assert third["region"] is None


def test_github() -> None:
    first, second, third = report(FINDINGS, "github").splitlines()
    assert first == (
        "::error file=a.rebeca,line=2,col=2,endLine=2,endColumn=12,title=RS104::"
        '"knowrebecs" is not a keyword%0Adid you mean "knownrebecs"?'
    )
    assert second.startswith("::warning file=a.rebeca,line=2,col=17,")
    assert third == "::error file=dir%2C with%3A signs/b.rebeca,title=RS801::no such file"


# --- SARIF -------------------------------------------------------------------------------------

# What SARIF 2.1.0 demands of the parts that rebsync uses; nothing else may occur in them.
_TEXT = {"type": "object", "required": ["text"], "properties": {"text": {"type": "string"}}}
_LINE = {"type": "integer", "minimum": 1}
_REGION = {
    "type": "object",
    "required": ["startLine"],
    "properties": dict.fromkeys(("startLine", "startColumn", "endLine", "endColumn"), _LINE),
    "additionalProperties": False,
}
_ARTIFACT = {
    "type": "object",
    "required": ["uri"],
    "properties": {"uri": {"type": "string", "pattern": "^[!-~]+$"}},
    "additionalProperties": False,
}
_LOCATION = {
    "type": "object",
    "required": ["physicalLocation"],
    "properties": {
        "id": {"type": "integer", "minimum": 0},
        "message": _TEXT,
        "physicalLocation": {
            "type": "object",
            "required": ["artifactLocation"],
            "properties": {"artifactLocation": _ARTIFACT, "region": _REGION},
            "additionalProperties": False,
        },
    },
    "additionalProperties": False,
}
_CHANGE = {
    "type": "object",
    "required": ["artifactLocation", "replacements"],
    "properties": {
        "artifactLocation": _ARTIFACT,
        "replacements": {
            "type": "array",
            "minItems": 1,
            "items": {
                "type": "object",
                "required": ["deletedRegion"],
                "properties": {"deletedRegion": _REGION, "insertedContent": _TEXT},
                "additionalProperties": False,
            },
        },
    },
    "additionalProperties": False,
}
_FIX = {
    "type": "object",
    "required": ["artifactChanges"],
    "properties": {
        "description": _TEXT,
        "artifactChanges": {"type": "array", "minItems": 1, "items": _CHANGE},
    },
    "additionalProperties": False,
}
_RESULT = {
    "type": "object",
    "required": ["message"],
    "properties": {
        "ruleId": {"type": "string"},
        "ruleIndex": {"type": "integer", "minimum": 0},
        "level": {"enum": ["none", "note", "warning", "error"]},
        "message": _TEXT,
        "locations": {"type": "array", "items": _LOCATION},
        "relatedLocations": {"type": "array", "items": _LOCATION},
        "partialFingerprints": {"additionalProperties": {"type": "string"}},
        "fixes": {"type": "array", "items": _FIX},
    },
    "additionalProperties": False,
}
_DRIVER = {
    "type": "object",
    "required": ["name"],
    "properties": {
        "name": {"type": "string"},
        "version": {"type": "string"},
        "rules": {
            "type": "array",
            "uniqueItems": True,
            "items": {"required": ["id"], "properties": {"shortDescription": _TEXT}},
        },
    },
    "additionalProperties": False,
}
_RUN = {
    "type": "object",
    "required": ["tool", "results"],
    "properties": {
        "tool": {"required": ["driver"], "properties": {"driver": _DRIVER}},
        "columnKind": {"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
        "results": {"type": "array", "items": _RESULT},
    },
    "additionalProperties": False,
}
SCHEMA = {
    "type": "object",
    "required": ["version", "runs"],
    "properties": {
        "$schema": {"type": "string", "format": "uri"},
        "version": {"const": "2.1.0"},
        "runs": {"type": "array", "items": _RUN},
    },
    "additionalProperties": False,
}


def sarif(findings: list[Findings]) -> Any:  # noqa: ANN401  a JSON document
    """The one run of a SARIF log, found to be valid."""
    log = json.loads(report(findings, "sarif"))
    jsonschema.validate(log, SCHEMA)
    return log["runs"][0]


def test_sarif() -> None:
    run = sarif(FINDINGS)
    rules = [rule["id"] for rule in run["tool"]["driver"]["rules"]]
    assert rules == ["RS104", "RS502", "RS801"]
    assert [rules[r["ruleIndex"]] for r in run["results"]] == [r["ruleId"] for r in run["results"]]
    first, _, third = run["results"]
    replacement = first["fixes"][0]["artifactChanges"][0]["replacements"][0]
    assert replacement["insertedContent"]["text"] == "knownrebecs"
    uri = third["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
    assert uri == "dir%2C%20with%3A%20signs/b.rebeca"


def test_sarif_without_findings() -> None:
    assert sarif([])["results"] == []


def prints(text: str, *needles: str) -> list[str]:
    """The fingerprints of findings at the given words."""
    found = tuple(
        Diagnostic("RS203", Span(text.index(n), text.index(n) + len(n)), f"unknown {n}")
        for n in needles
    )
    results = sarif([Findings(Source("a.rebeca", text), found)])["results"]
    return [r["partialFingerprints"]["rebsyncFinding/v1"] for r in results]


def test_fingerprints_survive_changes_elsewhere_and_tell_findings_apart() -> None:
    before = prints("a = 1;\nb = 2;\n", "a", "b")
    assert len(set(before)) == 2
    assert prints("// new line\n\n    a = 1;\nc = 3;\nb = 2;\n", "a = 1", "b")[1] == before[1]
    assert len(set(prints("x = 1; x = 1;", "x", "x"))) == 2


# --- streams -----------------------------------------------------------------------------------


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(("variable", "coloured"), [("FORCE_COLOR", True), ("NO_COLOR", False)])
def test_colours_are_for_terminals(
    monkeypatch: pytest.MonkeyPatch, variable: str, coloured: bool
) -> None:
    for name in ("FORCE_COLOR", "NO_COLOR", "TERM"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv(variable, "1")
    monkeypatch.setenv("TERM", "xterm")
    terminal, pipe = Terminal(), io.StringIO()
    print_report(FINDINGS, terminal)
    print_report(FINDINGS, pipe)
    assert ("\x1b[" in terminal.getvalue()) == coloured
    assert "\x1b[" not in pipe.getvalue()


def test_styles_end_with_their_line() -> None:
    pieces = (Piece("a", "bold red"), Piece("b\n"), Piece("c\nd\n", "dim"))
    assert coloured(pieces) == "\x1b[1;31ma\x1b[0mb\n\x1b[2mc\x1b[0m\n\x1b[2md\x1b[0m\n"


def test_summary() -> None:
    assert summary(FINDINGS) == "2 errors, 1 warning in 2 files"
    assert summary([MISSING]) == "1 error"
    assert summary([Findings(Source("a", ""), ())]) == ""
