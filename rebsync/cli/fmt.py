"""`rebsync fmt`: bring models into the canonical layout."""

from __future__ import annotations

import sys

import click

from rebsync.cli.options import write_output
from rebsync.cli.paths import expand
from rebsync.cli.status import Status, worst
from rebsync.diagnostics import Findings, RebsyncError, Severity
from rebsync.files import MODEL, STANDARD_INPUT, read_source
from rebsync.patches import patch
from rebsync.report import print_report
from rebsync.source import Source
from rebsync.terminal import say
from rebsync.writing import replace_text, told


@click.command("fmt")
@click.argument("paths", metavar="FILE...", nargs=-1, required=True)
@click.option("--check", is_flag=True, help="Write nothing; exit 1 if a file would change.")
@click.option("--diff", is_flag=True, help="Write nothing; show what would change.")
def command(paths: tuple[str, ...], check: bool, diff: bool) -> Status:
    """Bring models into the canonical layout.

    A directory stands for all models below it; `-` reads standard input and writes the result to
    standard output.
    """
    outcomes = [_one(path, check, diff) for path in expand(paths, (MODEL,))]
    return worst(outcomes)


def _one(path: str | RebsyncError, check: bool, diff: bool) -> Status:
    try:
        if isinstance(path, RebsyncError):
            raise path
        source = read_source(path)
        text = formatted(source)
    except RebsyncError as error:
        print_report(error.findings, sys.stderr)
        return Status.UNUSABLE
    if check or diff:
        return _compare(source, text, diff)
    if path == STANDARD_INPUT:
        write_output("-", text)
    elif replace_text(path, text):
        say(f"formatted {told(path)}", err=True)
    return Status.CLEAN


def formatted(source: Source) -> str:
    """The text of a model laid out; a RebsyncError with its errors when it does not parse."""
    from rebsync.grammars.formatting import format_text
    from rebsync.grammars.parser import parse_model

    parsed = parse_model(source)
    errors = tuple(d for d in parsed.diagnostics if d.severity is Severity.ERROR)
    if errors:
        raise RebsyncError([Findings(source, errors)])
    return format_text(source.text)


def _compare(source: Source, text: str, diff: bool) -> Status:
    if text == source.text:
        return Status.CLEAN
    if diff:
        write_output("-", patch(source.text, text, source.path, f"{source.path} (formatted)"))
    else:
        say(f"would format {source.path}", err=True)
    return Status.FINDINGS
