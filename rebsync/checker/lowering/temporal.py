"""The temporal part of properties: formulas over predicates."""

from __future__ import annotations

from collections.abc import Callable

from rebsync import properties as p
from rebsync.checker import formulas as f
from rebsync.model import Name
from rebsync.static import Analysis
from rebsync.static.constants import Value, constant


def temporal(
    formula: p.Formula, predicate: Callable[[p.Formula], int], analysis: Analysis
) -> f.Formula:
    """A formula whose largest parts without temporal operators have become predicates."""

    def below(each: p.Formula) -> f.Formula:
        return temporal(each, predicate, analysis)

    if not is_temporal(formula):
        return f.Atom(predicate(formula))
    match formula:
        case p.Not(operand):
            return f.Not(below(operand))
        case p.And(left, right):
            return f.And(below(left), below(right))
        case p.Or(left, right):
            return f.Or(below(left), below(right))
        case p.Implies(left, right):
            return f.Or(f.Not(below(left)), below(right))
        case p.Ltl(operator, operands):
            return f.Temporal(operator, tuple(below(o) for o in operands))
        case p.Tctl(timed, bound, operands):
            return f.Timed(timed, _bound(bound, analysis), tuple(below(o) for o in operands))
        case _:
            raise AssertionError(f"not temporal: {formula}")


def is_temporal(formula: p.Formula) -> bool:
    """Whether a formula has a temporal operator; defines never do."""
    match formula:
        case p.Ltl() | p.Tctl():
            return True
        case _:
            return any(is_temporal(o) for o in p.operands(formula))


def counts_steps(formula: p.Formula) -> bool:
    """Whether a formula of LTL has `X`, for which a step of time is a step."""
    match formula:
        case p.Ltl("X", _):
            return True
        case _:
            return any(counts_steps(o) for o in p.operands(formula))


def _bound(bound: p.TimeBound | None, analysis: Analysis) -> f.Bound | None:
    if bound is None:
        return None

    def env(name: Name) -> Value | None:
        symbol = analysis.env.get(name.name)
        return symbol.value if symbol else None

    limit = constant(bound.limit, env)
    assert isinstance(limit, int)
    return bound.comparison, limit
