"""The cases: files of Python, `cases/NAME.py`, each with the model and findings to expect."""

from __future__ import annotations

from pathlib import Path

from rebsync.files import read_source
from rebsync.printing import print_model
from rebsync.reverse.recovery import Extracted, extract

CASES = sorted((Path(__file__).parent / "cases").glob("*.py"))


def extracted(case: Path) -> Extracted:
    """What a file is read as."""
    return extract({case.name: read_source(str(case))})


def said(found: Extracted) -> tuple[str, str]:
    """The model as text, and a line for each finding: place, grade, reason, hint."""
    lines = []
    for finding in sorted(found.findings, key=lambda f: (f.span.start, f.why)):
        line = finding.source.position(finding.span.start).line
        hint = f" [{finding.hint}]" if finding.hint else ""
        lines.append(f"{line}: {finding.grade.value}: {finding.why}{hint}\n")
    return print_model(found.model), "".join(lines)
