"""Models that say less than the code they come from: what a verdict can say of them.

`@Unreadable` statements stand for code that was not read, and `@Open` message servers get messages
that nobody in the model sends: the model is an open system, and only closed ones are searched.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from rebsync import model as m
from rebsync.checker.passing import passed_lines
from rebsync.checker.problem import CodePlace, Problem
from rebsync.checker.result import Result, Verdict, Violation
from rebsync.checker.telling import Teller
from rebsync.checker.trace import Change, ShownMessage, ShownRebec, TraceStep
from rebsync.reserved import OPEN
from rebsync.source import Source
from rebsync.statements import UNREADABLE

_SHOWN = 5  # places that a reason names
_LOOSE = "a run may be none of the code, of which the model does more in these places"


def limited(problem: Problem, result: Result, teller: Teller) -> Result:
    """The result of a search, as far as it holds whatever the model lacks.

    No property is known to hold of a model with `@Unreadable` or `@Open`, or with gaps. A run to a
    violation is one of the system unless it passes code that was not read: what does not run has
    no part in it, and nothing need come from outside.
    """
    unread, opened = problem.unread or _unreadable(problem), _open(problem)
    ways = (
        _ways(teller, result) if unread or problem.loose else [frozenset()] * len(result.violations)
    )
    result = _told_of_code(problem, result, ways)
    if not unread and not opened and not problem.gaps:
        return result
    certain = {
        v.name
        for v, way in zip(result.violations, ways, strict=True)
        if not unread or (_is_shown_by_run(problem, v) and not _passed(unread, way))
    }
    verdicts = tuple((name, _verdict(name, found, certain)) for name, found in result.properties)
    reasons = [result.reason or "", *problem.gaps]
    reasons += [_unread_reason(unread)] if unread else []
    reasons += [_open_reason(opened)] if opened else []
    is_violated = any(v.name in certain for v in result.violations)
    return replace(
        result,
        verdict="violated" if is_violated else "undetermined",
        reason="; ".join(filter(None, reasons)),
        properties=verdicts,
    )


def _ways(teller: Teller, result: Result) -> list[frozenset[int]]:
    """The lines of the model that the run to each violation passes."""
    return [frozenset[int]().union(*passed_lines(teller, v.trace)) for v in result.violations]


def _is_shown_by_run(problem: Problem, violation: Violation) -> bool:
    """Whether a run is all there is to a violation, so that other runs have no part in it."""
    branching = {each.name for each in problem.properties.tctl}
    return violation.kind != "zeno" and violation.name not in branching


def _passed(places: Sequence[CodePlace], way: frozenset[int]) -> bool:
    return any(p.lines is None or p.lines & way for p in places)


def _verdict(name: str, found: Verdict, certain: Collection[str]) -> Verdict:
    return "violated" if found == "violated" and name in certain else "undetermined"


def _told_of_code(problem: Problem, result: Result, ways: Sequence[frozenset[int]]) -> Result:
    """The result with what is assumed, and with the places in the code of what its runs do."""
    if not problem.assumptions and not problem.code:
        return result
    caveats = [*result.caveats, *(f"assumed: {each}" for each in problem.assumptions)]
    passed = [p for p in problem.loose if any(_passed([p], way) for way in ways)]
    if passed:
        caveats.append(f"{_LOOSE}: {_some(passed)}")
    violations = tuple(
        replace(v, trace=replace(v.trace, steps=tuple(_in_code(s, problem) for s in v.trace.steps)))
        for v in result.violations
    )
    return replace(result, caveats=tuple(caveats), violations=violations)


def _in_code(step: TraceStep, problem: Problem) -> TraceStep:
    shown = problem.texts.shown

    def of_message(message: ShownMessage) -> ShownMessage:
        to, server = message.receiver, message.server
        arguments = ((name, shown(to, server, name, v)) for name, v in message.arguments)
        return replace(message, arguments=tuple(arguments))

    def of_change(change: Change) -> Change:
        rebec, name = change.rebec, change.variable
        before, after = (shown(rebec, "", name, v) for v in (change.before, change.after))
        return Change(rebec, name, before, after)

    def of_rebec(rebec: ShownRebec) -> ShownRebec:
        variables = ((name, shown(rebec.name, "", name, v)) for name, v in rebec.variables)
        bag = tuple(map(of_message, rebec.bag))
        return replace(rebec, variables=tuple(variables), bag=bag)

    return replace(
        step,
        code=problem.code.get(step.line, ""),
        message=of_message(step.message) if step.message is not None else None,
        sent=tuple(map(of_message, step.sent)),
        changes=tuple(map(of_change, step.changes)),
        rebecs=tuple(map(of_rebec, step.rebecs)),
    )


def unreadable_lines(source: Source, model: m.Model) -> list[int]:
    """The lines of a model with statements that stand for code that was not read."""
    notes = (n for n in m.walk(model) if isinstance(n, m.Annotation) and n.name == UNREADABLE)
    return sorted({source.position(note.span.start).line for note in notes})


def _unreadable(problem: Problem) -> tuple[CodePlace, ...]:
    lines = unreadable_lines(problem.source, problem.analysis.model)
    return tuple(CodePlace(f"line {line}", frozenset({line})) for line in lines)


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


def _unread_reason(places: Sequence[CodePlace]) -> str:
    count = len(places)
    what = "a place was" if count == 1 else f"{count} places were"
    return f"{what} not read and may do anything: {_some(places)}"


def _open_reason(servers: list[str]) -> str:
    return f"nobody in the model sends what comes from outside to {_shown(servers)}"


def _some(places: Sequence[CodePlace]) -> str:
    return _shown([place.text for place in places])


def _shown(places: Sequence[str]) -> str:
    return ", ".join(places[:_SHOWN]) + (", ..." if len(places) > _SHOWN else "")
