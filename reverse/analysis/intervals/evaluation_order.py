"""Expressions that mean what they do in the model only if they are evaluated in its order.

The model evaluates operands and arguments from left to right, and what an assignment stores into
before the value. C++ leaves that open ([expr] and [expr.ass] of C++14), and Python finds what an
assignment stores into after the value. It matters where one part changes what another reads, which
the methods that are called decide: that is known when all classes have been read.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rebsync import model as m
from rebsync.reverse.findings import Finding, Findings, Grade, Ordered
from rebsync.source import NOWHERE, Source, Span
from rebsync.static import Analysis, analyse
from rebsync.static.effects import assigns_apart, conflicting, indices_of

_WHY = "the model evaluates this in an order that the code does not have"
_HINT = "say it in two statements"
_OPERATIONS = (m.Binary, m.Assign, m.Call, m.Index)


def note_body(findings: Findings, source: Source, within: str, body: Sequence[m.Statement]) -> None:
    """Keeps in mind what of a body of C++ may depend on the order in which it is evaluated."""
    for node in (n for statement in body for n in m.walk(statement)):
        if isinstance(node, _OPERATIONS):
            parts = [p for p in _parts(node) if p.span != node.span]
            if any(map(_may_act, parts)) and not all(_is_apart(p, node.span) for p in parts):
                findings.ordered.append(Ordered(source, within, node))


def note_store(findings: Findings, source: Source, within: str, store: m.Expression) -> None:
    """Keeps in mind an assignment of Python that may depend on what is found first."""
    match store:
        case m.Assign(_, target, value) if _may_act(value) or _may_act(target):
            if any(isinstance(n, m.Index) for n in m.walk(target)):
                findings.ordered.append(Ordered(source, within, store))
        case _:
            pass


def out_of_order(
    classes: tuple[m.ReactiveClass | m.Interface, ...], noted: Sequence[Ordered]
) -> Iterator[Finding]:
    """What was noted in the bodies of the classes of a model, and does depend on the order."""
    if noted:
        model = m.Model((), classes, None)
        analysis = analyse(model, fragment=True)
        known = {id(n): n for n in m.walk(model) if isinstance(n, _OPERATIONS)}
        for each in noted:
            is_known = id(each.expression) in known
            meant = [each.expression] if is_known else _alike(each.expression, known.values())
            if not meant or any(_depends(one, analysis) for one in meant):
                span = each.expression.span
                yield Finding(Grade.UNREADABLE, each.source, span, _WHY, _HINT, each.within)


def _alike(expression: m.Expression, among: Iterable[m.Expression]) -> Sequence[m.Expression]:
    """What stands in the model for an expression that was put together anew."""
    kind, span = type(expression), expression.span
    return [each for each in among if type(each) is kind and each.span == span]


def _depends(expression: m.Expression, analysis: Analysis) -> bool:
    if isinstance(expression, m.Assign):
        return assigns_apart(expression, analysis)
    return conflicting(_parts(expression), analysis)


def _parts(expression: m.Expression) -> tuple[m.Expression, ...]:
    """The operands that no rule of C++ puts in an order."""
    match expression:
        case m.Binary("&&" | "||"):
            return ()
        case m.Binary(_, left, right):
            return left, right
        case m.Assign(_, target, value):
            return target, value
        case m.Index():
            return tuple(indices_of(expression))
        case m.Call(target, _, arguments, after, deadline):
            every = (target, *arguments, after, deadline)
            return tuple(each for each in every if each is not None)
        case _:
            return ()


def _may_act(expression: m.Expression) -> bool:
    """Whether the value of an expression may not be all that it is for."""
    return any(
        isinstance(node, m.Assign | m.Postfix | m.Call)
        or (isinstance(node, m.Unary) and node.operator in ("++", "--"))
        for node in m.walk(expression)
    )


def _is_apart(part: m.Expression, whole: Span) -> bool:
    """Whether a part is evaluated elsewhere than where it counts, by a statement of its own."""
    made = (n for n in m.walk(part) if not isinstance(n, m.Paren))  # which may be put around it
    places = [n.span for n in made if n.span != NOWHERE]
    if whole == NOWHERE or not places:
        return not _may_act(part)
    return not any(map(whole.holds, places))
