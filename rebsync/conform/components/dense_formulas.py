"""Formulas over signals: LTL without `X`, and TCTL with bounds (MITL), on one run in real time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import inf

from rebsync.checker.formulas import And, Atom, Bound, Formula, Not, Or, Temporal, Timed, parts
from rebsync.conform.components.signals import Signal
from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class SignalEvaluator:
    """Formulas over the signals of conditions; all bounds are stricter by `margin` seconds."""

    signals: Mapping[Formula, Signal]
    unit: float
    margin: float = 0.0

    def signal(self, formula: Formula, positive: bool = True) -> Signal:
        """When a formula holds; a stricter bound is a looser one under a negation."""
        known = self.signals.get(formula)
        if known is not None:
            return known
        match formula:
            case Not(operand):
                return self.signal(operand, not positive).negated()
            case And(left, right):
                return self.signal(left, positive).both(self.signal(right, positive))
            case Or(left, right):
                return self.signal(left, positive).either(self.signal(right, positive))
            case Temporal(operator, operands):
                return self._temporal(operator, None, operands, positive)
            case Timed(operator, bound, operands):
                return self._temporal(operator[1], bound, operands, positive)
            case _:
                raise AssertionError(f"{formula} is no condition that was asked for")

    def _temporal(
        self, operator: str, bound: Bound | None, operands: tuple[Formula, ...], positive: bool
    ) -> Signal:
        stricter = self.margin if (operator in "FU") == positive else -self.margin
        low, high = _window(bound, self.unit, stricter)
        last = self.signal(operands[-1], positive)
        if operator == "F":
            return last.eventually(low, high)
        if operator == "G":
            return last.negated().eventually(low, high).negated()
        both = self.signals.get(Or(*operands))
        either = both if both is not None else self.signal(operands[0], positive).either(last)
        if operator == "U":
            return last.until(either, high)
        return either.negated().until(last.negated(), high).negated()

    def since(self, formula: Formula, violated: bool, positive: bool = True) -> float:
        """The earliest time at which an operator without bounds is decided; infinite: none is."""
        match formula:
            case Not(operand):
                return self.since(operand, violated, not positive)
            case And(left, right) | Or(left, right):
                return min(self.since(o, violated, positive) for o in (left, right))
            case Temporal(_, (operand,)) | Timed(_, None, (operand,)):
                found = self.signal(operand, positive)
                spans = found.false if violated == positive else found.true
                return spans[0][0] if spans else inf
            case _:
                return inf


def _window(bound: Bound | None, unit: float, stricter: float) -> tuple[float, float]:
    """From when to when, in seconds, an operator has to be fulfilled."""
    if bound is None:
        return 0.0, inf
    operator, limit = bound[0], bound[1] * unit
    if operator == "==":
        return limit, limit
    if operator in ("<", "<="):
        return 0.0, limit - stricter
    return max(limit + stricter, 0.0), inf


def is_dense(formula: Formula) -> bool:
    """Whether it can be evaluated here."""
    return all(map(_is_evaluated, parts(formula)))


def _is_evaluated(formula: Formula) -> bool:
    match formula:
        case Temporal(operator):
            return operator != "X"
        case Timed(operator, bound):
            later = bound is not None and bound[0] in (">", ">=", "==")
            return not (later and operator[1] == "U")
        case _:
            return True


def says_always(formula: Formula) -> bool:
    """Whether it does not matter in which state a run begins."""
    match formula:
        case Not(operand):
            return says_always(operand)
        case And(left, right) | Or(left, right):
            return says_always(left) and says_always(right)
        case Temporal("G" | "F", _) | Timed("AG" | "AF" | "EG" | "EF", None, _):
            return True
        case _:
            return False


def conditions_of(formula: Formula) -> Iterator[Formula]:
    """The greatest parts without temporal operators, and of `U` and `W` either operand."""
    if _is_condition(formula):
        yield formula
        return
    match formula:
        case Not(operand):
            yield from conditions_of(operand)
        case And(left, right) | Or(left, right):
            yield from conditions_of(left)
            yield from conditions_of(right)
        case Temporal(_, operands) | Timed(_, _, operands):
            for operand in operands:
                yield from conditions_of(operand)
            if len(operands) == 2 and all(map(_is_condition, operands)):
                yield Or(*operands)


def _is_condition(formula: Formula) -> bool:
    return not any(isinstance(f, Temporal | Timed) for f in parts(formula))


def is_true(condition: Formula, truth: Mapping[int, bool]) -> bool:
    match condition:
        case Atom(predicate):
            return truth[predicate]
        case Not(operand):
            return not is_true(operand, truth)
        case And(left, right):
            return is_true(left, truth) and is_true(right, truth)
        case Or(left, right):
            return is_true(left, truth) or is_true(right, truth)
        case _:
            raise AssertionError(f"{condition} is no condition")
