"""Models with parts that were not read: their verdicts say no more than what was read can show."""

from __future__ import annotations

from dataclasses import replace

from rebsync import model as m
from rebsync.checker.problem import Problem
from rebsync.checker.result import Result, Verdict
from rebsync.statements import UNREADABLE

_SHOWN = 5  # lines that the reason names


def limited(problem: Problem, result: Result) -> Result:
    """The result of a search, as far as it holds whatever `@Unreadable` statements do.

    Such a statement stands for code that was not read and may do anything, so that no property is
    known to hold. A run to a violation is shown, but the code may do otherwise.
    """
    lines = _lines(problem)
    if not lines:
        return result
    verdicts: tuple[tuple[str, Verdict], ...] = tuple(
        (name, "undetermined" if found == "satisfied" else found)
        for name, found in result.properties
    )
    return replace(result, verdict="undetermined", reason=_reason(lines), properties=verdicts)


def _lines(problem: Problem) -> list[int]:
    """The lines of the statements that stand for code that was not read."""
    found = {
        problem.source.position(node.span.start).line
        for node in m.walk(problem.analysis.model)
        if isinstance(node, m.Annotation) and node.name == UNREADABLE
    }
    return sorted(found)


def _reason(lines: list[int]) -> str:
    count = len(lines)
    shown = ", ".join(map(str, lines[:_SHOWN])) + (", ..." if count > _SHOWN else "")
    what = "statement stands" if count == 1 else "statements stand"
    where = "line" if count == 1 else "lines"
    return f"{count} {what} for code that was not read, and that may do anything: {where} {shown}"
