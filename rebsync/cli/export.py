"""`rebsync export`: print a model in the form that another tool accepts."""

from __future__ import annotations

import sys

import click

from rebsync.cli.options import output_option, refuse_to_overwrite, write_output
from rebsync.cli.status import Status, status_of
from rebsync.cli.verify import view_named, view_options
from rebsync.diagnostics import Findings, RebsyncError, Severity
from rebsync.files import read_source
from rebsync.report import print_report


@click.command("export")
@click.argument("model", metavar="MODEL")
@click.option(
    "--for",
    "tool",
    type=click.Choice(["rmc", "pins"]),
    required=True,
    help="The tool that will read it.",
)
@view_options
@output_option
@click.pass_context
def command(ctx: click.Context, /, model: str, tool: str, output: str, **_: object) -> Status:
    """Print a model in the form that another tool accepts.

    For rmc: as the official compiler 2.30 reads it, with the annotations of rebsync taken out.
    What RMC cannot take, or runs differently, is reported.

    For pins: a language module of LTSmin in C, with the properties' assertions and definitions as
    state labels; --property, --language and --semantics are for it alone.
    """
    if tool == "pins":
        return _pins(ctx, model, output)
    for option in ("property_file", "language", "semantics"):
        if ctx.get_parameter_source(option) is click.core.ParameterSource.COMMANDLINE:
            name = option.removesuffix("_file")
            raise click.UsageError(f"--{name} is for --for pins: RMC is told by itself")
    return _rmc(model, output)


def _rmc(model: str, output: str) -> Status:
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


def _pins(ctx: click.Context, model: str, output: str) -> Status:
    from rebsync.checker.choosing import semantics_for
    from rebsync.checker.lowering import lower
    from rebsync.checker.pins import pins_module
    from rebsync.cli.problem import keep_what_is_read, read_problem

    given = ctx.params
    problem = read_problem(model, given["property_file"], untimed=given["language"] == "core")
    keep_what_is_read(problem, output)
    program, _ = lower(problem.analysis, problem.properties)
    write_output(output, pins_module(problem, view_named(given) or semantics_for(program, problem)))
    return Status.CLEAN
