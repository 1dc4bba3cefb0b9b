"""`rebsync lint`: report mistakes in models and properties."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from pathlib import Path

import click

from rebsync.cli.options import format_option
from rebsync.cli.paths import MODEL, PROPERTY, expand
from rebsync.cli.status import Status, status_of, worst
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.edits import apply_edits, certain_edits
from rebsync.files import STANDARD_INPUT, read_source
from rebsync.report import print_report, summary
from rebsync.source import Source
from rebsync.terminal import say
from rebsync.writing import replace_text, told

_ROUNDS = 10


@click.command("lint")
@click.argument("paths", metavar="FILE...", nargs=-1, required=True)
@click.option("--fix", is_flag=True, help="Make the corrections that are certain.")
@format_option
def command(paths: tuple[str, ...], fix: bool, style: str) -> Status:
    """Report mistakes in models and properties.

    A directory stands for all models and properties below it. A property file is checked against
    the model of the same name beside it.
    """
    findings: list[Findings] = []
    statuses = []
    for path in expand(paths, (MODEL, PROPERTY)):
        found, status = _one(path, fix)
        findings += found
        statuses.append(status)
    print_report(findings, sys.stdout, style)
    if style == "text" and (counted := summary(findings)):
        sys.stdout.flush()
        say(counted, err=True)
    return worst(statuses)


def _one(path: str | RebsyncError, fix: bool) -> tuple[tuple[Findings, ...], Status]:
    try:
        if isinstance(path, RebsyncError):
            raise path
        source = read_source(path)
        found = _fixed(source) if fix and path != STANDARD_INPUT else lint(source)
    except RebsyncError as error:
        return error.findings, Status.UNUSABLE
    return (found,), status_of([found])


def lint(source: Source) -> Findings:
    """All findings of a model or a property file."""
    if source.path.endswith(PROPERTY):
        return _lint_property(source)
    from rebsync.grammars.parser import parse_model
    from rebsync.static import analyse

    parsed = parse_model(source)
    analysis = analyse(parsed.model, incomplete=not parsed.ok)
    return _sorted(source, (*parsed.diagnostics, *analysis.diagnostics))


def _lint_property(source: Source) -> Findings:
    from rebsync.grammars.parser import parse_model
    from rebsync.grammars.properties import parse_properties
    from rebsync.property_check import check_properties
    from rebsync.static import analyse

    parsed = parse_properties(source)
    model_path = Path(source.path).with_suffix(MODEL)
    if not os.path.lexists(model_path):
        message = f"the model {model_path.name} is not beside this file"
        alone = Diagnostic("RS911", parsed.properties.span, message, "names were not checked")
        return _sorted(source, (*parsed.diagnostics, alone))
    model = parse_model(read_source(str(model_path)))
    analysis = analyse(model.model, incomplete=not model.ok)
    incomplete = not (parsed.complete and model.ok)
    found = check_properties(parsed.properties, analysis, incomplete=incomplete)
    return _sorted(source, (*parsed.diagnostics, *found))


def _sorted(source: Source, found: Iterable[Diagnostic]) -> Findings:
    ordered = sorted(dict.fromkeys(found), key=lambda d: (d.span.start, d.code, d.message))
    return Findings(source, tuple(ordered))


def _fixed(source: Source) -> Findings:
    """The findings that remain when the certain corrections have been made in the file."""
    found = lint(source)
    text = source.text
    for _ in range(_ROUNDS):
        edits = certain_edits(found.diagnostics)
        if not edits:
            break
        text = apply_edits(text, edits)
        found = lint(Source(source.path, text))
    if replace_text(source.path, text):
        say(f"corrected {told(source.path)}", err=True)
    return found
