"""Writing one run in the format that was asked for."""

from __future__ import annotations

import sys
from functools import partial
from typing import TYPE_CHECKING

from rebsync.cli.options import write_output
from rebsync.cli.status import Status
from rebsync.diagnostics import Diagnostic, Findings, RebsyncError
from rebsync.files import read_source
from rebsync.source import NOWHERE

if TYPE_CHECKING:
    from rebsync.checker.problem import Problem
    from rebsync.checker.trace import Trace

STYLES = ("text", "json", "svg", "html")


def write_run(trace: Trace, problem: Problem, style: str, output: str) -> None:
    """Writes a run of a model to a file, or to standard output for `-`."""
    if style == "text" and output == "-":
        from rebsync.checker.show.text import print_trace

        print_trace(trace, sys.stdout)
        return
    write_output(output, _text(trace, problem, style))


def serve_run(trace: Trace, problem: Problem, port: int) -> None:
    """Serves the page of a run until it is interrupted."""
    from rebsync.checker.show.page import trace_page
    from rebsync.cli.run_details import live_in
    from rebsync.cli.serving import serve

    live = live_in(problem, trace.semantics, partial(trace_page, trace, problem.source))
    serve(live, port)


def _text(trace: Trace, problem: Problem, style: str) -> str:
    match style:
        case "json":
            from rebsync.checker.show.data import trace_json
            from rebsync.cli.run_details import moving_in

            return trace_json(trace, moving_in(problem))
        case "svg":
            from rebsync.checker.show.chart import chart

            return chart(trace)
        case "html":
            from rebsync.checker.show.page import trace_page
            from rebsync.cli.run_details import details_in

            return trace_page(trace, problem.source, details_in(problem, trace.semantics))
        case _:
            from rebsync.checker.show.pieces import plain
            from rebsync.checker.show.text import trace_lines

            return plain(trace_lines(trace))


def replay_file(
    problem: Problem, path: str, violation: str | None, style: str, output: str
) -> Status:
    """Runs a recorded run through the interpreter again."""
    from rebsync.checker.exploration import INSTRUCTIONS
    from rebsync.checker.lowering import lower
    from rebsync.checker.show.replay import trace_from_json
    from rebsync.checker.simulate import NotARun, replay
    from rebsync.checker.telling import Teller
    from rebsync.checker.views import view_of

    source = read_source(path)
    recorded = trace_from_json(source, violation)
    program, _ = lower(problem.analysis, problem.properties)
    view = view_of(program, recorded.semantics)
    view.limit(INSTRUCTIONS)
    teller = Teller(view, problem.source)
    try:
        trace = replay(teller, recorded.actions, recorded.loop)
    except NotARun as different:
        message = f"step {different.number} of this run is none of {problem.source.path}"
        if different.repeats:
            message = f"this run does not repeat after step {different.number}"
        hint = "the model has changed since: verify it again"
        found = Diagnostic("RS924", NOWHERE, message, hint)
        raise RebsyncError([Findings(source, (found,))]) from None
    write_run(trace, problem, style, output)
    return Status.VIOLATED if trace.steps[-1].failure else Status.CLEAN
