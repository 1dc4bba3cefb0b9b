"""Findings as text, JSON, SARIF or GitHub annotations."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TextIO

from rebsync.diagnostics import Findings, Severity
from rebsync.report_text import Piece, finding_pieces
from rebsync.terminal import without_commands

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
    if style == "text" and stream.isatty() and not os.environ.get("NO_COLOR"):
        _print_coloured(findings, stream)
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


def _print_coloured(findings: Sequence[Findings], stream: TextIO) -> None:
    pieces = _pieces(findings)
    if not pieces:
        return
    from rich.console import Console
    from rich.text import Text

    console = Console(file=stream, highlight=False, soft_wrap=True)
    console.print(Text.assemble(*((p.text, p.style) for p in pieces)), end="")
