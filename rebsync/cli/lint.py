"""`rebsync lint`: report mistakes in models and properties."""

from __future__ import annotations

import sys

import click

from rebsync.cli.options import format_option
from rebsync.cli.paths import expand
from rebsync.cli.status import Status, status_of, worst
from rebsync.diagnostics import Findings, RebsyncError
from rebsync.edits import apply_edits, certain_edits
from rebsync.files import MODEL, PROPERTY, STANDARD_INPUT, read_source
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
        from rebsync.lint import lint

        source = read_source(path)
        found = _fixed(source) if fix and path != STANDARD_INPUT else lint(source)
    except RebsyncError as error:
        return error.findings, Status.UNUSABLE
    return (found,), status_of([found])


def _fixed(source: Source) -> Findings:
    """The findings that remain when the certain corrections have been made in the file."""
    from rebsync.lint import lint

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
