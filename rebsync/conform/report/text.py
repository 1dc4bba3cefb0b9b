"""The answer as lines of text, and as findings with places in the model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rebsync.conform.conformance import Allowed, Conformance, Deviation
from rebsync.conform.matching import Subject
from rebsync.conform.properties import Evaluated
from rebsync.diagnostics import Diagnostic, Findings, Severity
from rebsync.source import NOWHERE, Span

_FEW = 3
_LAST = 5


def lines(found: Conformance, subject: Subject, paths: Sequence[str]) -> Iterator[str]:
    """What there is to say, for people."""
    name = subject.source.path
    steps = f"{found.compared:,} of {found.recorded:,} recorded steps"
    match found.verdict:
        case "conforms":
            yield f"{name}: conforms, {found.compared:,} steps"
        case "undetermined":
            yield f"{name}: undetermined after {steps}: {found.reason}"
        case "deviates":
            yield f"{name}: deviates after {steps}"
        case "violated":
            yield f"{name}: conforms up to a violation, {steps}"
    if found.deviation is not None:
        yield from _deviation(found, found.deviation, subject, paths)
    yield from _lateness(found)
    for evaluated in found.properties:
        yield f"  {property_line(evaluated)}"
    for note in found.notes:
        yield f"  note: {note}"


def _deviation(
    found: Conformance, deviation: Deviation, subject: Subject, paths: Sequence[str]
) -> Iterator[str]:
    yield f"  {deviation.kind}: {deviation.message}"
    if deviation.place is not None:
        yield f"  recorded: {paths[deviation.place.file]}, message {deviation.place.number}"
    if deviation.line:
        yield f"  model: {subject.source.path}:{deviation.line}"
    if deviation.code is not None:
        yield f"  code: {deviation.code.path}:{deviation.code.line}"
    for allowed in deviation.allowed[:_FEW]:
        yield f"  allowed: {allowed_line(allowed)}"
    if len(deviation.allowed) > _FEW:
        yield f"  allowed: {len(deviation.allowed) - _FEW} more"
    for served in found.last[-_LAST:]:
        node = subject.observable.nodes[served.rebec]
        yield f"  before: {served.now} {node}.{served.server}({served.arguments})"
    for sentence in deviation.explanation:
        yield f"  topics: {sentence}"


def allowed_line(allowed: Allowed) -> str:
    """A step that the model allows."""
    state = ", ".join(f"{name} = {value}" for name, value in allowed.state)
    at = f"{allowed.rebec}.{allowed.server}({allowed.arguments}) at {allowed.start}"
    return f"{at} -> {state}" if state else at


def _lateness(found: Conformance) -> Iterator[str]:
    if found.lateness.greatest is not None:
        time, rebec, seconds = found.lateness.greatest
        basis = "" if found.lateness.basis == "announced" else ", counted from the earliest step"
        yield f"  greatest time error: {seconds:+.3f} s, {rebec} at {time}{basis}"


def property_line(evaluated: Evaluated) -> str:
    """A property with its verdict on the run."""
    about = []
    if evaluated.time is not None and evaluated.verdict != "undetermined":
        about.append(f"at {evaluated.time}")
    if evaluated.verdict == "open":
        about.append("holds so far" if evaluated.is_fulfilled else "not fulfilled yet")
    if evaluated.margin is not None:
        how = "met by at least" if evaluated.margin >= 0 else "missed by"
        about.append(f"bounds {how} {abs(evaluated.margin)}")
    if evaluated.reason:
        about.append(evaluated.reason)
    remarks = f" ({', '.join(about)})" if about else ""
    return f"{evaluated.name}: {evaluated.verdict}{remarks}"


# --- findings


def findings(found: Conformance, subject: Subject) -> tuple[Findings, ...]:
    """What is wrong, with places in the model, or in code that people wrote."""
    deviating = _deviating(found, found.deviation, subject) if found.deviation is not None else ()
    others = tuple(_diagnostics(found))
    return (*deviating, Findings(subject.source, others)) if others else deviating


def _deviating(found: Conformance, deviation: Deviation, subject: Subject) -> tuple[Findings, ...]:
    code = "RS986" if found.verdict == "violated" else "RS980"
    hint = None
    if deviation.allowed:
        shown = [allowed_line(a) for a in deviation.allowed[:_FEW]]
        hint = "the model allows " + ", or ".join(shown)
    message = f"{deviation.kind}: {deviation.message}"
    source, span, place = subject.source, _line(subject, deviation.line), deviation.code
    if place is not None and place.span is not None:
        source, span = place.span.source, Span(place.span.start, place.span.end)
    elif place is not None:
        message += f" (in the code: {place.path}:{place.line})"
    return (Findings(source, (Diagnostic(code, span, message, hint),)),)


def _diagnostics(found: Conformance) -> Iterator[Diagnostic]:
    if found.verdict == "undetermined" and found.deviation is None:
        yield Diagnostic("RS984", NOWHERE, found.reason, severity=Severity.WARNING)
    for evaluated in found.properties:
        if evaluated.verdict == "violated":
            message = f"the recorded run violates {evaluated.name} at {evaluated.time}"
            yield Diagnostic("RS987", NOWHERE, message)
        elif evaluated.verdict == "undetermined":
            message = f"{evaluated.name}: {evaluated.reason}"
            yield Diagnostic("RS984", NOWHERE, message, severity=Severity.WARNING)


def _line(subject: Subject, line: int) -> Span:
    if not line:
        return NOWHERE
    texts = subject.source.text.splitlines(keepends=True)
    start = sum(map(len, texts[: line - 1]))
    text = texts[line - 1]
    indent = len(text) - len(text.lstrip())
    return Span(start + indent, start + len(text.rstrip()))
