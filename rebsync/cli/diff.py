"""`rebsync diff`: what is different between two models, whatever they are written in."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import click

from rebsync.cli.options import output_option, write_output
from rebsync.cli.status import Status
from rebsync.terminal import lines_text, say

if TYPE_CHECKING:
    from rebsync.diagnostics import Findings
    from rebsync.roundtrip.diff.behaviour import Behaviour
    from rebsync.roundtrip.diff.difference import Comparison
    from rebsync.roundtrip.package.models import CodeModel

FORMATS = ("text", "json", "sarif", "github", "html")
_DONE = {
    "same": Status.CLEAN,
    "different": Status.FINDINGS,
    "undetermined": Status.UNDETERMINED,
}


@click.command("diff")
@click.argument("left", metavar="A")
@click.argument("right", metavar="B")
@click.option(
    "--depth",
    type=click.Choice(["identical", "equal"]),
    default="equal",
    show_default=True,
    help="identical: every order, name and parenthesis counts.",
)
@click.option(
    "--format",
    "style",
    type=click.Choice(FORMATS),
    default="text",
    show_default=True,
    help="How to print the differences; html: a page with both sides.",
)
@click.option(
    "--behaviour", is_flag=True, help="Compare what the two do: their state spaces, up to names."
)
@click.option(
    "--max-states",
    type=click.IntRange(1),
    default=20_000,
    show_default=True,
    metavar="N",
    help="States of each side that --behaviour looks at.",
)
@output_option
def command(
    left: str, right: str, depth: str, style: str, behaviour: bool, max_states: int, output: str
) -> Status:
    """Compare two models: element by element, statement by statement.

    A and B are models, packages of code, or REVISION:PATH of either in git, such as HEAD~3:robots.
    Exit status: 0 no difference, 1 differences, 4 where something of the code cannot be read or a
    generated run-time part is edited, 2 nothing read. With --behaviour it is that of what they do.
    """
    from rebsync.report import print_report
    from rebsync.roundtrip.diff.compare import compare
    from rebsync.roundtrip.diff.difference import Depth
    from rebsync.roundtrip.package.revisions import read_side
    from rebsync.roundtrip.verdict.unmodelled import with_edits

    if left == right == "-":
        raise click.UsageError("standard input can be one of the two only")
    sides = with_edits(left, read_side(left)), with_edits(right, read_side(right))
    comparison = compare(sides[0].given, sides[1].given, Depth(depth))
    done = _behaviour(comparison, sides, max_states) if behaviour else None
    write_output(output, _text(comparison, sides, (left, right), depth, style, done))
    loose = [found for side in sides for found in _loose(side)]
    if style == "text":
        print_report(loose, sys.stderr)
        sys.stdout.flush()
        if not comparison.is_empty:
            say(_counted(comparison), err=True)
    if done is not None:
        return _DONE[done.verdict] if not loose else max(_DONE[done.verdict], Status.FINDINGS)
    if comparison.is_undetermined:
        return Status.UNDETERMINED
    return Status.CLEAN if comparison.is_empty and not loose else Status.FINDINGS


def _loose(side: CodeModel) -> Iterator[Findings]:
    """Where the model allows more than the code does: there equal models do not tell all."""
    for found in side.findings:
        loose = tuple(d for d in found.diagnostics if d.code in ("RS942", "RS947"))
        if loose:
            yield replace(found, diagnostics=loose)


def _counted(comparison: Comparison) -> str:
    from rebsync.roundtrip.diff.report import counted

    return counted(comparison)


def _behaviour(comparison: Comparison, sides: tuple[CodeModel, CodeModel], most: int) -> Behaviour:
    from rebsync.roundtrip.behaviour.bisimulation import compare_behaviour
    from rebsync.roundtrip.diff.behaviour import SAME

    if comparison.is_empty:
        return SAME
    return compare_behaviour(sides[0].given, sides[1].given, most)


def _text(
    comparison: Comparison,
    sides: tuple[CodeModel, CodeModel],
    names: tuple[str, str],
    depth: str,
    style: str,
    done: Behaviour | None,
) -> str:
    from rebsync.roundtrip.diff import report

    match style:
        case "json":
            return report.as_json(comparison, *names, depth, done)
        case "sarif":
            return report.as_sarif(comparison, done)
        case "github":
            return report.as_commands(comparison, done)
        case "html":
            from rebsync.roundtrip.diff.page import sides_page

            return sides_page(comparison, sides[0].given, sides[1].given, done)
        case _:
            return lines_text(report.lines(comparison, done))
