"""Properties on the finite run that a recording shows: progression of formulas, state by state.

A formula is rewritten by each state to what has to hold from the next one on (Bacchus and Kabanza,
Using temporal logics to express search control knowledge for planning, 2000); once that is true or
false so is the formula, whatever follows (LTL3: Bauer, Leucker and Schallhart, Runtime verification
for LTL and TLTL, 2011). Else it is open. On one run "on all paths" and "on some path" are the same.
"""

from __future__ import annotations

from typing import TypeAlias

from rebsync.checker.formulas import And, Atom, Bound, Formula, Not, Or, Temporal, Timed
from rebsync.records import dataclass
from rebsync.unions import assert_never


@dataclass(frozen=True, slots=True)
class Owed:
    """A timed operator from a state on that was left `elapsed` units ago; `name` tells it apart."""

    operator: str
    bound: Bound | None
    operands: tuple[Formula, ...]
    elapsed: int


@dataclass(frozen=True, slots=True)
class Conjunction:
    parts: frozenset[Rest]


@dataclass(frozen=True, slots=True)
class Disjunction:
    parts: frozenset[Rest]


@dataclass(frozen=True, slots=True)
class Negation:
    part: Rest


@dataclass(frozen=True, slots=True)
class Next:
    """A formula that has to hold in the next state."""

    formula: Formula


Rest: TypeAlias = "bool | Owed | Conjunction | Disjunction | Negation | Next"


def both(*parts: Rest) -> Rest:
    """The conjunction, simplified."""
    flat: set[Rest] = set()
    for part in parts:
        if part is False:
            return False
        if isinstance(part, Conjunction):
            flat |= part.parts
        elif part is not True:
            flat.add(part)
    return True if not flat else flat.pop() if len(flat) == 1 else Conjunction(frozenset(flat))


def either(*parts: Rest) -> Rest:
    """The disjunction, simplified."""
    flat: set[Rest] = set()
    for part in parts:
        if part is True:
            return True
        if isinstance(part, Disjunction):
            flat |= part.parts
        elif part is not False:
            flat.add(part)
    return False if not flat else flat.pop() if len(flat) == 1 else Disjunction(frozenset(flat))


def negated(part: Rest) -> Rest:
    """The negation, simplified."""
    if isinstance(part, bool):
        return not part
    return part.part if isinstance(part, Negation) else Negation(part)


class Progression:
    """One formula on one run.

    `margin` is by how much the bounds of its timed operators were met at the least: the units that
    were left of `<= c` when it was fulfilled, or that it took beyond `>= c`. None: no bound was.
    """

    def __init__(self, formula: Formula) -> None:
        self.formula = formula
        self.rest: Rest = Next(formula)
        self.margin: int | None = None
        self._truth: dict[int, bool] = {}

    def see(self, truth: dict[int, bool], elapsed: int) -> Rest:
        """A next state: what is true in it, and how long after the last one it is reached."""
        self._truth = truth
        self.rest = self._through(self.rest, elapsed)
        return self.rest

    def _through(self, rest: Rest, elapsed: int) -> Rest:
        match rest:
            case bool():
                return rest
            case Conjunction(parts):
                return both(*(self._through(part, elapsed) for part in parts))
            case Disjunction(parts):
                return either(*(self._through(part, elapsed) for part in parts))
            case Negation(part):
                return negated(self._through(part, elapsed))
            case Next(formula):
                return self._holds(formula)
            case Owed(operator, bound, operands, before):
                after = before + elapsed if bound is not None else 0
                return self._owed(operator, bound, operands, after)
            case _ as unreachable:
                assert_never(unreachable)

    def _holds(self, formula: Formula) -> Rest:
        """What has to hold later for a formula to hold in the present state."""
        match formula:
            case Atom(predicate):
                return self._truth[predicate]
            case Not(operand):
                return negated(self._holds(operand))
            case And(left, right):
                return both(self._holds(left), self._holds(right))
            case Or(left, right):
                return either(self._holds(left), self._holds(right))
            case Temporal("X", (operand,)):
                return Next(operand)
            case Temporal(operator, operands):
                return self._owed(operator, None, operands, 0)
            case Timed(operator, bound, operands):
                return self._owed(operator[1], bound, operands, 0)
            case _ as unreachable:
                assert_never(unreachable)

    def _owed(
        self, operator: str, bound: Bound | None, operands: tuple[Formula, ...], elapsed: int
    ) -> Rest:
        """`F`, `G`, `U` or `W` in a state that is reached some time after it has begun."""
        within, later = _within(bound, elapsed), _later(bound, elapsed)
        on: Rest = Owed(operator, bound, operands, elapsed) if later else operator in "GW"
        now = self._holds(operands[-1]) if within else operator in "GW"
        match operator:
            case "G":
                return both(now, on)
            case "F":
                self._met(now, bound, elapsed, within)
                return either(now, on)
            case "U":
                self._met(now, bound, elapsed, within)
                return either(now if within else False, both(self._holds(operands[0]), on))
            case _:
                return either(now if within else False, both(self._holds(operands[0]), on))

    def _met(self, now: Rest, bound: Bound | None, elapsed: int, within: bool) -> None:
        if not within or now is not True or bound is None:
            return
        operator, limit = bound
        left = limit - elapsed if operator in ("<", "<=", "==") else elapsed - limit
        self.margin = left if self.margin is None else min(self.margin, left)


def _within(bound: Bound | None, elapsed: int) -> bool:
    """Whether a time is one at which an operator may be fulfilled."""
    if bound is None:
        return True
    operator, limit = bound
    match operator:
        case "<":
            return elapsed < limit
        case "<=":
            return elapsed <= limit
        case ">":
            return elapsed > limit
        case ">=":
            return elapsed >= limit
        case "==":
            return elapsed == limit


def _later(bound: Bound | None, elapsed: int) -> bool:
    """Whether it may still be fulfilled at that time or after it."""
    if bound is None or bound[0] in (">", ">="):
        return True
    return elapsed < bound[1] if bound[0] == "<" else elapsed <= bound[1]
