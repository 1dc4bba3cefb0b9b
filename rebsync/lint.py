"""All findings of a model or a property file: syntax, names, types, structure, warnings."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from rebsync.config import settings_beside
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError, Severity
from rebsync.files import MODEL, PROPERTY, read_source
from rebsync.grammars.parser import Parsed, parse_model
from rebsync.grammars.properties import ParsedProperties, parse_properties
from rebsync.property_check import check_properties
from rebsync.source import Source
from rebsync.static import Analysis, analyse

_REMARK = re.compile(r"\s*// *rebsync: ignore((?:[ ,]+RS\d+)+)")


def lint(source: Source) -> Findings:
    """All findings of a model, or of a property file and the model of the same name beside it."""
    if source.path.endswith(PROPERTY):
        return _lint_property(source)
    parsed = parse_model(source)
    return Findings(source, unless_ignored(source, model_findings(parsed, analysed(parsed))))


def analysed(parsed: Parsed) -> Analysis:
    """The static semantics of what could be read of a model."""
    return analyse(parsed.model, incomplete=not parsed.ok)


def unless_ignored(source: Source, found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """The errors among what was found in a text, and the rest as far as nobody says to ignore it.

    Settings beside the text do, and `// rebsync: ignore CODE...` on a line or alone above it.
    """
    every = tuple(found)
    if all(d.severity is Severity.ERROR for d in every):
        return every
    codes: tuple[str, ...] = ()
    with suppress(RebsyncError):  # what is wrong with them is told by the commands that need them
        codes = settings_beside(source.path)[1].ignore
    return tuple(
        d
        for d in every
        if d.severity is Severity.ERROR
        or d.code not in {*codes, *_ignored_at(source, source.position(d.span.start).line)}
    )


def _ignored_at(source: Source, line: int) -> list[str]:
    """The codes that remarks on a line, and alone on the one above, name."""
    remarks = [_REMARK.search(source.line(line))]
    if line > 1:
        remarks.append(_REMARK.match(source.line(line - 1)))
    return [
        code for remark in remarks if remark is not None for code in re.findall(r"RS\d+", remark[1])
    ]


def model_findings(parsed: Parsed, analysis: Analysis) -> tuple[Diagnostic, ...]:
    """What is wrong with a model, in order of place."""
    return _sorted((*parsed.diagnostics, *analysis.diagnostics))


def property_findings(
    parsed: ParsedProperties, model: Parsed | None, analysis: Analysis | None
) -> tuple[Diagnostic, ...]:
    """What is wrong with a property file; names are checked where there is a model."""
    if model is None or analysis is None:
        message = f"the model {Path(parsed.source.path).stem}{MODEL} is not beside this file"
        alone = Diagnostic("RS911", parsed.properties.span, message, "names were not checked")
        return _sorted((*parsed.diagnostics, alone))
    incomplete = not (parsed.complete and model.ok)
    found = check_properties(parsed.properties, analysis, incomplete=incomplete)
    return _sorted((*parsed.diagnostics, *found))


def _lint_property(source: Source) -> Findings:
    parsed = parse_properties(source)
    path = Path(source.path).with_suffix(MODEL)
    model = parse_model(read_source(str(path))) if os.path.lexists(path) else None
    analysis = analysed(model) if model is not None else None
    return Findings(source, unless_ignored(source, property_findings(parsed, model, analysis)))


def _sorted(found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(sorted(dict.fromkeys(found), key=lambda d: (d.span.start, d.code, d.message)))
