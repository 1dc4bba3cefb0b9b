"""`rebsync export`: print a model in the form that another tool accepts."""

from __future__ import annotations

import sys

import click

from rebsync.cli.options import output_option, refuse_to_overwrite, write_output
from rebsync.cli.status import Status, status_of
from rebsync.diagnostics import Findings, RebsyncError, Severity
from rebsync.files import read_source
from rebsync.report import print_report


@click.command("export")
@click.argument("model", metavar="MODEL")
@click.option(
    "--for", "tool", type=click.Choice(["rmc"]), required=True, help="The tool that will read it."
)
@output_option
def command(model: str, tool: str, output: str) -> Status:
    """Print a model in the form that another tool accepts.

    For rmc: as the official compiler 2.30 reads it, with the annotations of rebsync taken out.
    What RMC cannot take, or runs differently, is reported.
    """
    from rebsync.forward.rmc import export_rmc
    from rebsync.grammars.parser import parse_model
    from rebsync.static import analyse

    source = read_source(model)
    refuse_to_overwrite(model, output)
    parsed = parse_model(source)
    found = (*parsed.diagnostics, *analyse(parsed.model, incomplete=not parsed.ok).diagnostics)
    errors = tuple(d for d in found if d.severity is Severity.ERROR)
    if errors:
        raise RebsyncError([Findings(source, errors)])
    text, limits = export_rmc(source, parsed.model)
    write_output(output, text)
    findings = [Findings(source, limits)]
    print_report(findings, sys.stderr)
    return status_of(findings)
