"""How much of some code is in the model, and what is not, as text or JSON."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from rebsync.diagnostics import Diagnostic, Findings, Severity
from rebsync.records import dataclass
from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.graph_json import Data, Item
from rebsync.reverse.recovery import Extracted
from rebsync.source import Source
from rebsync.terminal import json_text, lines_text

_CODES = {
    Grade.UNREADABLE: "RS941",
    Grade.APPROXIMATED: "RS942",
    Grade.UNBUILT: "RS944",
    Grade.ASSUMED: "RS947",
}
# Grades of what is not exact, the worst last, and what the report calls their numbers.
_INEXACT = {
    Grade.APPROXIMATED: "over_approximated",
    Grade.ASSUMED: "assumed",
    Grade.UNREADABLE: "unreadable",
}


@dataclass(frozen=True, slots=True)
class BodyShare:
    """How many statements a body has, and how many places of each grade are not exact."""

    statements: int
    inexact: tuple[int, ...]

    @property
    def text(self) -> str:
        """The share as a part of a sentence."""
        exact = max(self.statements - sum(self.inexact), 0)
        found = [f"{exact} of {self.statements} statements exact"]
        found += [f"{n} {g.value}" for n, g in zip(self.inexact, _INEXACT, strict=True) if n]
        return ", ".join(found)


def diagnostics(found: Iterable[Finding]) -> tuple[Findings, ...]:
    """The findings of each file, in the order of the text."""
    by_source: dict[str, tuple[Source, list[Finding]]] = {}
    for finding in different(found):
        by_source.setdefault(finding.source.path, (finding.source, []))[1].append(finding)
    return tuple(
        Findings(source, tuple(map(_diagnostic, sorted(each, key=lambda f: f.span.start))))
        for source, each in by_source.values()
    )


def different(found: Iterable[Finding]) -> Iterable[Finding]:
    """Each finding once: code that is read for each call of it may be listed several times."""
    places = {(f.source.path, f.span, f.grade, f.why, f.within): f for f in found}
    return places.values()


def _diagnostic(finding: Finding) -> Diagnostic:
    within = f" (in {finding.within})" if finding.within else ""
    message = f"{finding.grade.value}: {finding.why}{within}"
    severity = Severity.NOTE if finding.grade is Grade.UNBUILT else Severity.ERROR
    code, hint = _CODES[finding.grade], finding.hint or None
    return Diagnostic(code, finding.span, message, hint, severity=severity)


def shares(extracted: Extracted) -> list[tuple[str, BodyShare]]:
    """Each body with its share."""
    grades = Counter((f.within, f.grade) for f in extracted.findings)
    return [
        (name, BodyShare(count, tuple(grades[name, grade] for grade in _INEXACT)))
        for name, count in extracted.statements
    ]


def grade_of(extracted: Extracted) -> str:
    """The worst grade of all: exact, over-approximated, assumed or unreadable."""
    grades = {f.grade for f in extracted.findings}
    worst = next((g for g in reversed(_INEXACT) if g in grades), None)
    return worst.value if worst is not None else "exact"


def as_text(extracted: Extracted) -> str:
    """A line for each body, and one for all."""
    rows = [(name, share.text) for name, share in shares(extracted)]
    if outside := _outside(extracted):
        rows.append(("elsewhere", outside))
    rows.append(("all", summary(extracted)))
    width = max(len(name) for name, _ in rows)
    return lines_text(f"{name:{width}}  {text}" for name, text in rows)


def summary(extracted: Extracted) -> str:
    """How many statements of all bodies are exact, and how many are not."""
    found = [share for _, share in shares(extracted)]
    columns = zip([0] * len(_INEXACT), *(s.inexact for s in found), strict=True)
    return BodyShare(sum(s.statements for s in found), tuple(map(sum, columns))).text


def _outside(extracted: Extracted) -> str:
    """How many findings are in no body: files, plumbing, launch files."""
    bodies = {name for name, _ in extracted.statements}
    grades = Counter(f.grade for f in extracted.findings if f.within not in bodies)
    return ", ".join(f"{grades[grade]} {grade.value}" for grade in Grade if grades[grade])


def as_json(extracted: Extracted) -> str:
    """The report as one object."""
    return json_text(report_data(extracted), indent=2) + "\n"


def report_data(extracted: Extracted) -> Item:
    """The worst grade, the share of each body, the findings with their places."""
    bodies: list[Data] = [
        {
            "name": name,
            "statements": share.statements,
            **dict(zip(_INEXACT.values(), share.inexact, strict=True)),
        }
        for name, share in shares(extracted)
    ]
    findings: list[Data] = [_finding(f) for f in different(extracted.findings)]
    return {"grade": grade_of(extracted), "bodies": bodies, "findings": findings}


def _finding(finding: Finding) -> Item:
    position = finding.source.position(finding.span.start)
    return {
        "grade": finding.grade.value,
        "file": finding.source.path,
        "line": position.line,
        "column": position.column,
        "within": finding.within,
        "text": finding.text,
        "why": finding.why,
        "hint": finding.hint or None,
    }
