"""A model as the official compiler 2.30 and its checker RMC read it.

The user's own text is kept, comments and line numbers included; only what the compiler does not
know is taken out.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator

from rebsync import model as m
from rebsync.diagnostics import Diagnostic, Edit, Severity
from rebsync.edits import apply_edits
from rebsync.source import Source, Span

KEPT_ANNOTATIONS = frozenset(("priority", "globalPriority"))
_LONGEST_ARRAY = 127
_LOOPS = (m.While, m.For)


def export_rmc(source: Source, model: m.Model) -> tuple[str, tuple[Diagnostic, ...]]:
    """The text for the official compiler, and what it or RMC will still not take."""
    text = apply_edits(source.text, _edits(source, model))
    found = sorted(_limits(model), key=lambda d: (d.span.start, d.code))
    return text, tuple(found)


# --- what is taken out -------------------------------------------------------------------------


def _edits(source: Source, model: m.Model) -> list[Edit]:
    gone = _merged(_with_blanks(source.text, span) for span in _superfluous(model))
    starts = [span.start for span in gone]

    def inside(span: Span) -> bool:
        at = bisect_right(starts, span.start) - 1
        return at >= 0 and span.end <= gone[at].end

    numbers = (edit for edit in _literals(source, model) if not inside(edit.span))
    return [*(Edit(span, "") for span in gone), *numbers]


def _merged(spans: Iterable[Span]) -> list[Span]:
    """The spans in order, those that overlap made one."""
    merged: list[Span] = []
    for span in sorted(spans, key=lambda s: (s.start, s.end)):
        if merged and span.start <= merged[-1].end:
            merged[-1] = Span(merged[-1].start, max(span.end, merged[-1].end))
        else:
            merged.append(span)
    return merged


def _superfluous(model: m.Model) -> Iterator[Span]:
    """Annotations, and the empty statements that exist only for one such as `@Move`."""
    for node in m.walk(model):
        match node:
            case m.Block(statements=statements) | m.Case(statements=statements):
                for statement in statements:
                    if isinstance(statement, m.Empty) and statement.annotations:
                        yield statement.span
            case m.Annotation(name, _, span) if name not in KEPT_ANNOTATIONS:
                yield span


def _literals(source: Source, model: m.Model) -> Iterator[Edit]:
    """Numbers that are not plainly decimal."""
    for node in m.walk(model):
        match node:
            case m.IntLiteral(value, span) if source.slice(span) != str(value):
                yield Edit(span, str(value))
            case m.Type(_, dimensions, span) if dimensions:
                if "".join(source.slice(span).split()) != str(node):
                    yield Edit(span, str(node))
            case m.ReactiveClass(queue_length=length, queue_span=span):
                if source.slice(span) != str(length):
                    yield Edit(span, str(length))


def _with_blanks(text: str, span: Span) -> Span:
    """A place and the blanks behind it; all of its line but the line end where it is alone."""
    start, end = span.start, span.end
    while end < len(text) and text[end] in " \t":
        end += 1
    if end == len(text) or text[end] in "\r\n":
        while start and text[start - 1] in " \t":
            start -= 1
    return Span(start, end)


# --- what remains ------------------------------------------------------------------------------


def _limits(model: m.Model) -> Iterator[Diagnostic]:
    yield from _versions(model)
    declared: set[str] = set()
    for each in model.classes:
        if isinstance(each, m.Interface):
            message = f'RMC generates nothing for a model with an interface: "{each.name}"'
            yield _unfit(each.name_span, message, "make it an abstract reactive class")
        elif each.extends and each.extends not in declared:
            message = f'RMC needs the class "{each.extends}" before "{each.name}"'
            yield _unfit(each.extends_span, message, "move the class up")
        declared.add(each.name)
    for node in m.walk(model):
        yield from _node_limits(node)
        if isinstance(node, _LOOPS):
            yield from _loop_limits(node)


def _node_limits(node: m.Node) -> Iterator[Diagnostic]:
    match node:
        case m.Type(_, dimensions, span) if any(n > _LONGEST_ARRAY for n in dimensions):
            message = f"the compiler takes no two arrays longer than {_LONGEST_ARRAY} for equal"
            yield _unfit(span, message, "assign and pass such an array element by element")
        case m.Choice(options, span) if len({_bare(o) for o in options}) < len(options):
            message = "RMC does not end on a nondeterministic expression with equal options"
            yield _unfit(span, message, "write each option once")
        case m.Name("now" | "currentMessageArrival" | "currentMessageDeadline" as name, span):
            message = f"RMC merges states that differ in {name}"
            yield _differs(span, message, "its verdict may be wrong where it matters")


def _loop_limits(loop: m.While | m.For) -> Iterator[Diagnostic]:
    for node in m.walk(loop.body):
        match node:
            case m.Continue(span=span):
                yield _differs(span, "RMC runs `continue` as `break`", "write an if instead")
            case m.Choice(span=span):
                message = "RMC keeps the first choice in all rounds of a loop"
                yield _differs(span, message, "choose in a server that sends to itself")


def _versions(model: m.Model) -> Iterator[Diagnostic]:
    for each in model.classes:
        if isinstance(each, m.Interface) or each.extends or each.abstract or each.implements:
            message = "inheritance needs the language version 2.3"
            hint = "run RMC with -v 2.3 -e TIMED_REBECA"
            yield Diagnostic("RS752", each.name_span, message, hint, severity=Severity.NOTE)
            return


def _bare(expression: m.Expression) -> m.Expression:
    while isinstance(expression, m.Paren):
        expression = expression.inner
    return expression


def _unfit(span: Span, message: str, hint: str) -> Diagnostic:
    return Diagnostic("RS750", span, message, hint, severity=Severity.WARNING)


def _differs(span: Span, message: str, hint: str) -> Diagnostic:
    return Diagnostic("RS751", span, message, hint, severity=Severity.WARNING)
