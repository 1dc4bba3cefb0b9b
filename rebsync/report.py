"""Findings as text, JSON, SARIF or GitHub annotations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TextIO

from rebsync.diagnostics import Findings, Severity
from rebsync.report_text import Piece, coloured, finding_pieces
from rebsync.terminal import has_colours, without_commands

FORMATS = ("text", "json", "sarif", "github")


def report(findings: Sequence[Findings], style: str = "text") -> str:
    """The findings in one of the FORMATS, without colours."""
    match style:
        case "json":
            from rebsync.report_data import as_json

            return as_json(findings)
        case "sarif":
            from rebsync.report_data import as_sarif

            return as_sarif(findings)
        case "github":
            from rebsync.report_data import as_github

            return as_github(findings)
        case _:
            return without_commands("".join(piece.text for piece in _pieces(findings)))


def print_report(findings: Sequence[Findings], stream: TextIO, style: str = "text") -> None:
    """Write the findings to a stream; text on a terminal gets colours."""
    if style == "text" and has_colours(stream):
        stream.write(without_commands(coloured(_pieces(findings))))
    else:
        stream.write(report(findings, style))


def summary(findings: Sequence[Findings]) -> str:
    """`2 errors, 1 warning in 2 files`, or an empty text when there is nothing to count."""
    found = [d.severity for each in findings for d in each.diagnostics]
    counts = [
        f"{found.count(s)} {s.value}{'s' if found.count(s) > 1 else ''}"
        for s in Severity
        if s in found
    ]
    paths = {each.source.path for each in findings if each.diagnostics}
    files = f" in {len(paths)} files" if len(paths) > 1 else ""
    return ", ".join(counts) + files if counts else ""


def _pieces(findings: Sequence[Findings]) -> list[Piece]:
    return [
        piece
        for each in findings
        for diagnostic in each.diagnostics
        for piece in finding_pieces(each.source, diagnostic)
    ]
