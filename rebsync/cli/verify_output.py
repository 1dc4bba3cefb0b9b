"""What `rebsync verify` found, in the style that was asked for."""

from __future__ import annotations

import sys
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from rebsync.cli.options import write_output

if TYPE_CHECKING:
    from rebsync.checker.problem import Problem
    from rebsync.checker.result import Result, Violation


def write_result(result: Result, problem: Problem, given: dict[str, Any], output: str) -> None:
    """Writes what was found in the style that was asked for."""
    style = given["style"]
    if given["serve"]:
        _serve(result, problem, given["port"])
        return
    if style == "text" and output == "-":
        from rebsync.checker.show.text import print_result

        print_result(result, problem.source.path, sys.stdout, is_full=given["full"])
        return
    write_output(output, _text(result, problem, style, given))


def _serve(result: Result, problem: Problem, port: int) -> None:
    """Serves the page of a result until it is interrupted."""
    from rebsync.checker.show.page import result_page
    from rebsync.cli.run_details import live_in
    from rebsync.cli.serving import serve

    page = partial(result_page, result, problem.source, problem.property_source)
    serve(live_in(problem, result.semantics, page), port)


def _text(result: Result, problem: Problem, style: str, given: dict[str, Any]) -> str:
    match style:
        case "json":
            from rebsync.checker.show.data import result_json
            from rebsync.cli.run_details import moving_in

            return result_json(result, moving_in(problem))
        case "html":
            from rebsync.checker.show.page import result_page
            from rebsync.cli.run_details import details_in

            details = details_in(problem, result.semantics)
            return result_page(result, problem.source, problem.property_source, details)
        case "svg":
            from rebsync.checker.show.chart import chart

            violation = _violation(result, given["violation"])
            return chart(violation.trace, violation.message)
        case _:
            from rebsync.checker.show.pieces import plain
            from rebsync.checker.show.text import result_lines

            return plain(result_lines(result, problem.source.path, is_full=given["full"]))


def _violation(result: Result, wanted: str | None) -> Violation:
    for violation in result.violations:
        if wanted in (None, violation.name):
            return violation
    if wanted is None:
        raise click.UsageError(f"there is no run to draw: {result.verdict}")
    names = ", ".join(v.name for v in result.violations) or "none"
    raise click.UsageError(f'no violation is called "{wanted}"; there is {names}')
