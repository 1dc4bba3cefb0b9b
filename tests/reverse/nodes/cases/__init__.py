"""The cases: packages with the models and findings that are expected of them."""

from __future__ import annotations

from pathlib import Path

from rebsync.printing import print_model
from rebsync.reverse.files.reading import chosen
from rebsync.reverse.recovery import Extracted, extract

CASES = sorted(p for p in Path(__file__).parent.iterdir() if (p / "package").is_dir())


def extracted(case: Path) -> Extracted:
    """What the package of a case is read as."""
    return extract(chosen(str(case / "package")).files)


def said(found: Extracted) -> tuple[str, str]:
    """The model as text, and a line for each finding: place, grade, reason, hint."""
    lines = []
    for finding in sorted(found.findings, key=lambda f: (f.source.path, f.span.start, f.why)):
        path = finding.source.path.rpartition("/package/")[2]
        line = finding.source.position(finding.span.start).line
        hint = f" [{finding.hint}]" if finding.hint else ""
        lines.append(f"{path}:{line}: {finding.grade.value}: {finding.why}{hint}\n")
    return print_model(found.model), "".join(lines)
