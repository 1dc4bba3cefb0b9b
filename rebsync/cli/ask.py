"""`rebsync ask`: one question about what the nodes of a package do."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import TYPE_CHECKING

import click

from rebsync.cli.amounts import amount, duration
from rebsync.cli.options import write_output
from rebsync.cli.status import STATUS_OF, Status

if TYPE_CHECKING:
    from rebsync.checker.result import Result


@click.command("ask")
@click.argument("package", metavar="PACKAGE")
@click.argument("question", metavar="QUESTION")
@click.option(
    "--environment",
    default="free",
    show_default=True,
    metavar="free|none|FILE",
    help="What comes from outside: anything, nothing, or what the classes of FILE send.",
)
@click.option("--model", "written", metavar="FILE", help="Write the model of the package to FILE.")
@click.option("--max-states", type=click.IntRange(1), metavar="N", help="Stop at N states.")
@click.option(
    "--max-time",
    callback=duration,
    metavar="TIME",
    default="60s",
    show_default=True,
    help="Stop after 90, 90s, 5m or 1h.",
)
@click.option("--memory", callback=amount, metavar="SIZE", help="Stop at 500M or 2G of memory.")
@click.option(
    "--format",
    "style",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="How to print the answer.",
)
@click.option("-o", "--output", default="-", metavar="FILE", help="Write the answer to FILE.")
def command(
    package: str,
    question: str,
    environment: str,
    written: str | None,
    max_states: int | None,
    max_time: float | None,
    memory: int | None,
    style: str,
    output: str,
) -> Status:
    """Answer a question about what the nodes of a package do, by topics and fields.

    QUESTION is one of: "never P while Q", "always P while Q", "P leads to Q within 2 s", "P at most
    3 times", "at most 3 messages on TOPIC"; P is such as "cmd_vel.linear.x > 0 and not stop.data".
    Before the first message of a topic nothing is true or false of it. Exit status: 0 yes, 3 no,
    with a run, 4 undetermined, 2 not understood.
    """
    from rebsync.checker.exploration import Limits
    from rebsync.checker.problem import Options
    from rebsync.checker.verify import verify
    from rebsync.cli.packages import read_question
    from rebsync.cli.progress import progress

    problem = read_question(package, question, environment, written)
    limits = Limits(max_states, max_time, memory)
    with progress(sys.stderr) as report:
        options = Options(limits=limits, allowed=frozenset({"deadlock"}), first=True)
        result = verify(problem, options, report)
    result = _of_question(result)
    _tell(result, question, style, output)
    return STATUS_OF[result.verdict]


def _of_question(result: Result) -> Result:
    """What is said of a question: not what else was covered, nor that a violation ended it.

    Where the model fails in another way before, the question has no answer.
    """
    from rebsync.checker.result import Coverage

    result = replace(result, coverage=Coverage((), (), ()))
    if result.verdict != "violated":
        return result
    if any(violation.kind == "property" for violation in result.violations):
        return replace(result, reason=None)
    reason = f"what the nodes do is not known from here on: {result.violations[0].message}"
    return replace(result, verdict="undetermined", reason=reason)


def _tell(result: Result, question: str, style: str, output: str) -> None:
    if style == "json":
        from rebsync.checker.show.data import result_json

        write_output(output, result_json(result))
        return
    from rebsync.checker.show.pieces import plain
    from rebsync.checker.show.text import print_result, result_lines

    if output == "-":
        print_result(result, question, sys.stdout)
    else:
        write_output(output, plain(result_lines(result, question)))
