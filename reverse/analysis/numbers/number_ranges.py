"""Intervals of whole numbers: by how they are computed, by all that is stored, by what was tested.

Flow-insensitive for variables, which hold one of the numbers that are stored in them anywhere; what
is known where a number stands (`IsWithin`) narrows that.
"""

from __future__ import annotations

from functools import reduce

from rebsync.intervals import ANY, TRUTH, Interval, exactly, of_binary, signed, unsigned
from rebsync.reverse.analysis.facts import NO_FACTS, Facts, IsLess, IsWithin, bare, tested
from rebsync.reverse.analysis.held_values import all_held
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.stores import key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.walk import walk

_DEEPEST = 4  # of variables that are computed of others
_SIGNS = {
    **{Operator.ADD: "+", Operator.SUBTRACT: "-", Operator.MULTIPLY: "*"},
    **{Operator.TRUNCATING_DIVIDE: "/", Operator.TRUNCATING_REMAINDER: "%"},
}
_UPWARDS = frozenset({Operator.LESS, Operator.LESS_EQUAL, Operator.UNEQUAL})


class NumberRanges:
    """Numbers of one function."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes

    def of(self, value: e.Expression, facts: Facts, depth: int = 0) -> Interval:
        """All whole numbers that a value may be where some facts are known."""
        found = self._computed(value, facts, depth)
        for fact in facts:
            match fact:
                case IsWithin(of, interval) if of == value:
                    found = found.meet(interval) or found
                case IsLess(of, other) if of == value and depth < _DEEPEST:
                    most = self.of(other, NO_FACTS, depth + 1).high - 1
                    found = found.meet(Interval(ANY.low, most)) or found
                case _:
                    pass
        return found

    def _computed(self, value: e.Expression, facts: Facts, depth: int) -> Interval:
        whole = of_type(getattr(value, "type", t.UNKNOWN))
        match value:
            case e.Literal(int() as number):
                return exactly(int(number))
            case e.Convert(_, operand, t.Integer()):
                return self.of(operand, facts, depth).in_type(whole)
            case e.Conditional(test, then, otherwise):
                first = self.of(then, tested(facts, test, True), depth)
                return first.join(self.of(otherwise, tested(facts, test, False), depth))
            case e.Binary(Operator.FLOOR_MODULO, _, e.Literal(int() as bound)) if bound > 0:
                return Interval(0, bound - 1)
            case e.Binary(operator, left, right, t.Integer()) if operator in _SIGNS:
                parts = (self.of(p, facts, depth) for p in (left, right))
                return of_binary(_SIGNS[operator], *parts).in_type(whole)
            case e.Local() | e.Captured() | e.Global() | e.Attribute() if depth < _DEEPEST:
                return self._stored(value, whole, depth)
            case _:
                return whole

    def _stored(self, value: e.Expression, whole: Interval, depth: int) -> Interval:
        """All that is stored in a variable, if nothing else may store there."""
        function = self._notes.function
        if isinstance(value, e.Local) and (first := self._counted_from(value)) is not None:
            return Interval(first, whole.high)
        stored = all_held(self._notes.origins, value, function.name)
        values = [v for f, v in stored if isinstance(v, e.Expression)]
        if not values or len(values) < len(stored):
            return whole
        return reduce(Interval.join, (self.of(v, NO_FACTS, depth + 1) for v in values))

    def _counted_from(self, variable: e.Local) -> int | None:
        """Where a variable starts that loops only count up, as long as their tests bound it."""
        key = key_of(variable, self._notes.function.name)
        assert key is not None
        stores = self._notes.origins.graph.stores
        starts = [v for _, v in all_held(self._notes.origins, variable, self._notes.function.name)]
        steps = len(stores.changed(key))
        loops = [n for n in walk(self._notes.function) if isinstance(n, s.Loop)]
        counted = sum(
            _counts(node, variable)
            for loop in loops
            for node in loop.step
            if _bounds(loop, variable)
        )
        numbers = [v.value for v in starts if isinstance(v, e.Literal)]
        are_known = len(numbers) + steps == len(starts) and steps == counted > 0
        whole = [n for n in numbers if isinstance(n, int)]
        return min(whole) if are_known and whole and len(whole) == len(numbers) else None


def of_type(type_: t.Type) -> Interval:
    """The numbers of a type; any of what is no whole number."""
    match type_:
        case t.Truth():
            return TRUTH
        case t.Integer(int() as bits, is_signed):
            return signed(bits - 1) if is_signed else unsigned(bits)
        case _:
            return ANY


def _counts(node: s.Statement, variable: e.Local) -> bool:
    match node:
        case s.CompoundAssign(target, Operator.ADD, value):
            by = bare(value)
            return target == variable and isinstance(by, e.Literal) and by.value == 1
        case _:
            return False


def _bounds(loop: s.Loop, variable: e.Local) -> bool:
    match loop.test:
        case e.Binary(operator, left, _):
            return operator in _UPWARDS and bare(left) == variable
        case _:
            return False
