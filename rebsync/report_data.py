"""Findings for other programs: JSON, SARIF 2.1.0, GitHub workflow commands."""

from __future__ import annotations

import hashlib
import os
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, TypeAlias
from urllib.parse import quote

from rebsync import __version__
from rebsync.codes import CODES
from rebsync.diagnostics import Diagnostic, Findings, Severity
from rebsync.source import NOWHERE, Source, Span
from rebsync.terminal import encoded, json_text, printable, without_old_commands

Json: TypeAlias = dict[str, Any]

_SARIF_SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
_GITHUB = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "notice"}


def as_json(findings: Sequence[Findings]) -> str:
    """One object; its `findings` are flat, in the order in which the text prints them."""
    found = [_json_finding(source, diagnostic) for source, diagnostic in _flat(findings)]
    return dump({"version": 1, "findings": found})


def as_sarif(findings: Sequence[Findings]) -> str:
    """A SARIF 2.1.0 log with one run."""
    return sarif_log(findings, [{"rebsyncFinding/v1": p} for p in fingerprints(findings)])


def sarif_log(
    findings: Sequence[Findings],
    prints: Sequence[dict[str, str]],
    related: Sequence[Sequence[tuple[Source, Span, str]]] = (),
) -> str:
    """The same with fingerprints of the caller's, and places in other texts with their remarks.

    Both are for the diagnostics in the order in which they are told.
    """
    used = sorted({diagnostic.code for _, diagnostic in _flat(findings)})
    results = []
    for i, (source, diagnostic) in enumerate(_flat(findings)):
        result = _sarif_result(source, diagnostic, used)
        result["partialFingerprints"] = prints[i]
        if i < len(related) and related[i]:
            result["relatedLocations"] = [
                _sarif_related(n, *r) for n, r in enumerate(related[i], 1)
            ]
        results.append(result)
    driver = {
        "name": "rebsync",
        "version": __version__,
        "rules": [{"id": c, "shortDescription": {"text": CODES.get(c, c)}} for c in used],
    }
    run = {"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": results}
    return dump({"$schema": _SARIF_SCHEMA, "version": "2.1.0", "runs": [run]})


def as_github(findings: Sequence[Findings]) -> str:
    """Workflow commands that GitHub shows beside the changed lines."""
    lines = "".join(f"{_github_line(source, d)}\n" for source, d in _flat(findings))
    return without_old_commands(lines, "%23")


def _flat(findings: Sequence[Findings]) -> Iterator[tuple[Source, Diagnostic]]:
    return ((each.source, diagnostic) for each in findings for diagnostic in each.diagnostics)


def dump(value: Json) -> str:
    """One object, for people to look at, too."""
    return json_text(value, indent=2) + "\n"


def region(source: Source, span: Span) -> dict[str, int]:
    """Where a span starts and ends: lines and columns, counted from 1."""
    start, end = source.position(span.start), source.position(max(span.end, span.start))
    return {
        "startLine": start.line,
        "startColumn": start.column,
        "endLine": end.line,
        "endColumn": end.column,
    }


# --- JSON --------------------------------------------------------------------------------------


def _json_finding(source: Source, diagnostic: Diagnostic) -> Json:
    return {
        "code": diagnostic.code,
        "title": CODES.get(diagnostic.code),
        "severity": diagnostic.severity.value,
        "message": diagnostic.message,
        "hint": diagnostic.hint,
        "path": source.path,
        "region": None if diagnostic.span is NOWHERE else region(source, diagnostic.span),
        "fix": [{"region": region(source, e.span), "text": e.text} for e in diagnostic.edits],
        "related": [
            {"region": region(source, span), "message": remark}
            for span, remark in diagnostic.related
        ],
    }


# --- SARIF -------------------------------------------------------------------------------------


def _sarif_result(source: Source, diagnostic: Diagnostic, used: list[str]) -> Json:
    message = diagnostic.message + (f" ({diagnostic.hint})" if diagnostic.hint else "")
    result: Json = {
        "ruleId": diagnostic.code,
        "ruleIndex": used.index(diagnostic.code),
        "level": diagnostic.severity.value,
        "message": {"text": message},
        "locations": [_sarif_location(source, diagnostic.span)],
    }
    if diagnostic.related:
        result["relatedLocations"] = [
            _sarif_related(i, source, span, remark)
            for i, (span, remark) in enumerate(diagnostic.related, start=1)
        ]
    if diagnostic.edits:
        result["fixes"] = [_sarif_fix(source, diagnostic)]
    return result


def _sarif_related(number: int, source: Source, span: Span, remark: str) -> Json:
    return {"id": number, **_sarif_location(source, span), "message": {"text": remark}}


def _sarif_location(source: Source, span: Span) -> Json:
    place: Json = {"artifactLocation": _sarif_artifact(source)}
    if span is not NOWHERE:
        place["region"] = region(source, span)
    return {"physicalLocation": place}


def _sarif_artifact(source: Source) -> Json:
    path = Path(source.path)
    if path.is_absolute():
        return {"uri": path.as_uri()}
    return {"uri": quote(os.fsencode(path.as_posix()))}


def _sarif_fix(source: Source, diagnostic: Diagnostic) -> Json:
    changes = [
        {"deletedRegion": region(source, e.span), "insertedContent": {"text": e.text}}
        for e in diagnostic.edits
    ]
    change = {"artifactLocation": _sarif_artifact(source), "replacements": changes}
    fix: Json = {"artifactChanges": [change]}
    if diagnostic.hint:
        fix["description"] = {"text": diagnostic.hint}
    return fix


def fingerprints(findings: Sequence[Findings]) -> Iterator[str]:
    """Codes of the findings that do not change when lines above them come or go."""
    seen: Counter[tuple[str, str, str, str]] = Counter()
    for source, diagnostic in _flat(findings):
        line = ""
        if diagnostic.span is not NOWHERE:
            line = source.line(source.position(diagnostic.span.start).line).strip()
        key = (Path(source.path).as_posix(), diagnostic.code, diagnostic.message, line)
        seen[key] += 1
        yield hashlib.sha256(encoded("\0".join((*key, str(seen[key]))))).hexdigest()[:32]


# --- GitHub ------------------------------------------------------------------------------------


def _github_line(source: Source, diagnostic: Diagnostic) -> str:
    properties = {"file": source.path}
    if diagnostic.span is not NOWHERE:
        where = region(source, diagnostic.span)
        properties |= {"line": str(where["startLine"]), "col": str(where["startColumn"])}
        properties["endLine"] = str(where["endLine"])
        if where["endLine"] == where["startLine"]:
            properties["endColumn"] = str(where["endColumn"])
    properties["title"] = diagnostic.code
    listed = ",".join(f"{k}={_github_property(v)}" for k, v in properties.items())
    message = diagnostic.message + (f"\n{diagnostic.hint}" if diagnostic.hint else "")
    return f"::{_GITHUB[diagnostic.severity]} {listed}::{_github_data(message)}"


def _github_data(text: str) -> str:
    """What GitHub asks for; other controls than line ends would reach the log."""
    text = "\r".join(map(printable, text.split("\r")))
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _github_property(text: str) -> str:
    return _github_data(text).replace(":", "%3A").replace(",", "%2C")
