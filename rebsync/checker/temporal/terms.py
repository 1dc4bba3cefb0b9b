"""Formulas of LTL in negation normal form: numbered, and simplified while they are built."""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

from rebsync.checker.formulas import And, Atom, Formula, Not, Or, Temporal, Timed
from rebsync.unions import assert_never

Operator: TypeAlias = Literal["false", "true", "is", "not", "and", "or", "next", "until", "release"]
FALSE = 0
TRUE = 1


class Term(NamedTuple):
    """`is` and `not` have a predicate on the left, `next` one operand there."""

    operator: Operator
    left: int = 0
    right: int = 0


class Terms:
    """All terms of one formula; equal ones have one number, operands lower ones than their term."""

    def __init__(self) -> None:
        self._terms = [Term("false"), Term("true")]
        self._numbers = {term: number for number, term in enumerate(self._terms)}

    def __getitem__(self, number: int) -> Term:
        return self._terms[number]

    def build(self, formula: Formula, wanted: bool) -> int:
        """The number of a formula, or of its negation when it is not `wanted`.

        ValueError: the formula has an operator of TCTL.
        """
        match formula:
            case Atom(predicate):
                return self._number(Term("is" if wanted else "not", predicate))
            case Not(operand):
                return self.build(operand, not wanted)
            case And(left, right) | Or(left, right):
                both = isinstance(formula, And) is wanted
                combine = self.both if both else self.either
                return combine(self.build(left, wanted), self.build(right, wanted))
            case Temporal():
                return self._temporal(formula, wanted)
            case Timed():
                raise ValueError(f"{formula.operator} is an operator of TCTL, not of LTL")
            case _:
                assert_never(formula)

    def _temporal(self, formula: Temporal, wanted: bool) -> int:
        operands = [self.build(operand, wanted) for operand in formula.operands]
        last, always = operands[-1], self.release if wanted else self.until
        match formula.operator:
            case "X":
                return self.next(last)
            case "G":
                return always(FALSE if wanted else TRUE, last)
            case "F":
                return self.until(TRUE, last) if wanted else self.release(FALSE, last)
            case "U":
                return self.until(*operands) if wanted else self.release(*operands)
            case "W":  # p W q is q R (p || q), its negation !q U (!p && !q)
                either = self.either(*operands) if wanted else self.both(*operands)
                return always(last, either)
            case _:
                assert_never(formula.operator)

    def both(self, left: int, right: int) -> int:
        """`left && right`."""
        return self._combined("and", FALSE, TRUE, left, right)

    def either(self, left: int, right: int) -> int:
        """`left || right`."""
        return self._combined("or", TRUE, FALSE, left, right)

    def next(self, operand: int) -> int:
        """`X operand`."""
        return operand if operand in (FALSE, TRUE) else self._number(Term("next", operand))

    def until(self, left: int, right: int) -> int:
        """`left U right`; `F right` when left is true."""
        return self._unfolding("until", "release", FALSE, TRUE, left, right)

    def release(self, left: int, right: int) -> int:
        """`left R right`, the dual of until; `G right` when left is false."""
        return self._unfolding("release", "until", TRUE, FALSE, left, right)

    def _combined(
        self, operator: Operator, absorbing: int, neutral: int, left: int, right: int
    ) -> int:
        if left == right or right == neutral:
            return left
        if left == neutral:
            return right
        if absorbing in (left, right) or self._opposite(left, right):
            return absorbing
        return self._number(Term(operator, min(left, right), max(left, right)))

    def _opposite(self, left: int, right: int) -> bool:
        one, other = self[left], self[right]
        return {one.operator, other.operator} == {"is", "not"} and one.left == other.left

    def _unfolding(
        self, own: Operator, dual: Operator, idle: int, eager: int, left: int, right: int
    ) -> int:
        """An until (`idle` false, `eager` true), or with all of it exchanged a release."""
        if left in (idle, right) or right in (FALSE, TRUE):
            return right
        inner = self[right]
        if inner.operator == own:
            if inner.left in (left, eager):  # p U (p U q) = p U q, p U F q = F q
                return right
            if left == eager:  # F (p U q) = F q
                return self._unfolding(own, dual, idle, eager, eager, inner.right)
        if left == eager and inner.operator == dual and inner.left == idle:
            deeper = self[inner.right]
            if deeper.operator == own and deeper.left == eager:  # F G F p = G F p
                return right
        return self._number(Term(own, left, right))

    def _number(self, term: Term) -> int:
        if term not in self._numbers:
            self._numbers[term] = len(self._terms)
            self._terms.append(term)
        return self._numbers[term]
