"""Models that say less than the code they come from: what a verdict can say of them.

`@Unreadable` statements stand for code that was not read, and `@Open` message servers get messages
that nobody in the model sends: the model is an open system, and only closed ones are searched.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rebsync import model as m
from rebsync.checker.problem import Problem
from rebsync.checker.result import Result, Verdict
from rebsync.checker.trace import TraceStep
from rebsync.reserved import OPEN
from rebsync.statements import UNREADABLE

_SHOWN = 5  # places that a reason names
_LOOSE = "a run may be none of the code, of which the model does more in these places"


def limited(problem: Problem, result: Result) -> Result:
    """The result of a search, as far as it holds whatever the model lacks.

    No property is known to hold of a model with `@Unreadable` or `@Open`, or with gaps. A run to a
    violation is one of the system unless code was not read, as nothing need come from outside.
    """
    result = _told_of_code(problem, result)
    unread, opened = problem.unread or _unreadable(problem), _open(problem)
    if not unread and not opened and not problem.gaps:
        return result
    verdicts: tuple[tuple[str, Verdict], ...] = tuple(
        (name, "undetermined" if found == "satisfied" else found)
        for name, found in result.properties
    )
    reasons = [result.reason or "", *problem.gaps]
    reasons += [_unread_reason(unread)] if unread else []
    reasons += [_open_reason(opened)] if opened else []
    is_violated = result.verdict == "violated" and not unread
    verdict: Verdict = "violated" if is_violated else "undetermined"
    return replace(
        result, verdict=verdict, reason="; ".join(filter(None, reasons)), properties=verdicts
    )


def _told_of_code(problem: Problem, result: Result) -> Result:
    """The result with what is assumed, and with the places in the code of what its runs do."""
    if not problem.assumptions and not problem.code:
        return result
    caveats = [*result.caveats, *(f"assumed: {each}" for each in problem.assumptions)]
    if problem.loose and result.violations:
        caveats.append(f"{_LOOSE}: {_some(problem.loose)}")
    violations = tuple(
        replace(v, trace=replace(v.trace, steps=tuple(_in_code(s, problem) for s in v.trace.steps)))
        for v in result.violations
    )
    return replace(result, caveats=tuple(caveats), violations=violations)


def _in_code(step: TraceStep, problem: Problem) -> TraceStep:
    return replace(step, code=problem.code.get(step.line, ""))


def _unreadable(problem: Problem) -> tuple[str, ...]:
    """The statements that stand for code that was not read, by their lines."""
    found = {
        problem.source.position(node.span.start).line
        for node in m.walk(problem.analysis.model)
        if isinstance(node, m.Annotation) and node.name == UNREADABLE
    }
    return tuple(f"line {line}" for line in sorted(found))


def _open(problem: Problem) -> list[str]:
    """The message servers of rebecs that get messages from outside."""
    analysis = problem.analysis
    main = analysis.model.main
    started = {r.type.name for r in main.rebecs} if main is not None else set()
    lineages = (c.lineage for name, c in analysis.classes.items() if name in started)
    above = {name for lineage in lineages for name in lineage}
    return [
        f"{owner.name}.{member.name}"
        for owner in analysis.model.classes
        if isinstance(owner, m.ReactiveClass) and owner.name in above
        for member in owner.members
        if isinstance(member, m.MessageServer) and any(a.name == OPEN for a in member.annotations)
    ]


def _unread_reason(places: Sequence[str]) -> str:
    count = len(places)
    what = "a place was" if count == 1 else f"{count} places were"
    return f"{what} not read and may do anything: {_some(places)}"


def _open_reason(servers: list[str]) -> str:
    return f"nobody in the model sends what comes from outside to {_some(servers)}"


def _some(places: Sequence[str]) -> str:
    return ", ".join(places[:_SHOWN]) + (", ..." if len(places) > _SHOWN else "")
