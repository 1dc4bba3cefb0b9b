"""What there is to say of checked packages, in each of the forms of the command."""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.roundtrip.verdict.outcome import Outcome
from rebsync.roundtrip.verdict.report.text import as_github, as_json, as_sarif, told_lines
from rebsync.terminal import lines_text


def as_text(outcomes: Sequence[Outcome], style: str, *, is_full: bool = False) -> str:
    """What there is to say of some packages, in one of the forms of the command."""
    match style:
        case "json":
            return as_json(outcomes)
        case "sarif":
            return as_sarif(outcomes)
        case "github":
            return as_github(outcomes)
        case "junit":
            from rebsync.roundtrip.verdict.report.junit import as_junit

            return as_junit(outcomes)
        case _:
            from rebsync.report import report

            parts = (
                lines_text(told_lines(o, is_full=is_full)) + report(o.findings) for o in outcomes
            )
            return "".join(parts)
