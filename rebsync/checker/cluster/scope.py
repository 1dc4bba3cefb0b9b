"""What a cluster is not asked for: all that needs more than a search of states."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.checker.problem import Options, Problem
from rebsync.diagnostics import RebsyncError


def check_scope(problem: Problem, options: Options) -> None:
    """Raises RebsyncError (RS934) when a cluster cannot answer all of what is asked."""
    if reason := next(_reasons(problem, options), None):
        what, hint = reason
        message = f"a cluster does not {what}"
        raise RebsyncError.of(
            problem.source.path, "RS934", message, f"{hint}, or leave --cluster out"
        )


def _reasons(problem: Problem, options: Options) -> Iterator[tuple[str, str]]:
    """What it does not do, and what else can be done."""
    given = problem.properties
    if temporal := [entry.name for entry in (*given.ltl, *given.tctl)]:
        asserted = " and ".join(f"--property-name {entry.name}" for entry in given.assertions)
        hint = f"name the assertions alone ({asserted})" if asserted else "write an assertion"
        yield f"decide LTL and TCTL ({', '.join(temporal)})", hint
    if problem.is_measured:
        yield "measure", "leave --measure and --time-between out"
    if options.symmetry:
        yield "reduce states by symmetry", "leave --symmetry out"
    if options.engine == "interpreted":
        yield "interpret", "leave --engine out"
