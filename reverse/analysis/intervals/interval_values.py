"""Which values expressions can have where the intervals of the variables are known.

The transfer functions of the interval analysis: what expressions give, what they write, and what a
condition says of variables once it is true or false.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import field
from functools import reduce
from typing import TypeAlias, TypeVar

from rebsync import model as m
from rebsync.intervals import (
    ANY,
    INT32,
    INTEGERS,
    TRUTH,
    Interval,
    compared,
    exactly,
    of_binary,
    of_unary,
    within_int,
)
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals import writes
from rebsync.reverse.analysis.intervals.needs import Mark, Need
from rebsync.reverse.analysis.intervals.writes import array_of, variable_of, written
from rebsync.reverse.models.building import bare, is_calm
from rebsync.source import Span

_OPPOSITE = {"<": ">=", ">=": "<", ">": "<=", "<=": ">", "==": "!=", "!=": "=="}
_TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "==", "!=": "!="}
_COMPARES = frozenset(_TURNED)
_LOOKS = frozenset({"/", "%", ">>"})
_BITS = frozenset({"&", "|", "^"})
_Key = TypeVar("_Key", str, Span)
_Operand: TypeAlias = tuple[m.Expression, Interval]


@dataclass(slots=True)
class IntervalValues:
    """The intervals of variables at one point of a body, and what is noted on the way there.

    `widths` are the bits of the numbers to be looked at, by name; `types` the types of other
    variables, and by `self.x` those of state variables that others hide, of which nothing else is
    known; `parameters` hide such from the start. `known` is what some names hold when a body
    starts, `always` what some hold at any time. `state` are the state variables, `called` those
    that functions of the class may change. `needs` has what must hold of expressions, by their
    ids. `wraps` says whether sums of the code wrap, and `cuts` to which bounds some expressions are
    brought where they do not, by their ids. `results` are the types of what functions give.

    `trusts_counters` says whether what only counts up is taken to stay below the greatest `int`.

    `broken` are variables that may get another number than an `int` holds, `counted` those that
    only count up to one, `failed` the needs that may not hold. `stored` has all that variables of
    `widths` get, `left` what bodies leave in those of `state`, `indices` all that the indices of
    elements can be, by the places of the elements.
    """

    widths: Mapping[str, int]
    types: Mapping[str, m.Type] = field(default_factory=dict)
    known: Mapping[str, Interval] = field(default_factory=dict)
    always: Mapping[str, Interval] = field(default_factory=dict)
    state: Collection[str] = ()
    called: Collection[str] = ()
    needs: Mapping[int, Sequence[Need]] = field(default_factory=dict)
    wraps: bool = True
    trusts_counters: bool = True
    cuts: Mapping[int, Interval] = field(default_factory=dict)
    results: Mapping[str, m.Type] = field(default_factory=dict)
    parameters: Collection[str] = ()
    broken: set[str] = field(default_factory=set)
    counted: set[str] = field(default_factory=set)
    failed: set[Mark] = field(default_factory=set)
    stored: dict[str, Interval] = field(default_factory=dict)
    left: dict[str, Interval] = field(default_factory=dict)
    indices: dict[Span, Interval] = field(default_factory=dict)
    _now: dict[str, Interval] = field(default_factory=dict)
    _locals: dict[str, m.Type] = field(default_factory=dict)

    # --- variables ------------------------------------------------------------------------------

    def _variable(self, place: m.Expression) -> str | None:
        """The variable that a place is, or is an element of: `self.x` if something hides `x`."""
        name = array_of(place)
        if name is None or not (name in self._locals or name in self.parameters):
            return name
        return writes.own(name) if writes.is_own(place) else name

    def _of(self, name: str) -> Interval:
        return self._now[name] if name in self._now else self._at_start(name)

    def _at_start(self, name: str) -> Interval:
        return self.known[name] if name in self.known else self._any(name)

    def _any(self, name: str) -> Interval:
        """What a variable holds at any time."""
        if name in self.always:
            return self.always[name]
        if name in self.widths:
            return within_int(self.widths[name])
        return self._of_type(name)

    def _of_type(self, name: str) -> Interval:
        if name.startswith(writes.own("")):
            return values_of(self.types[name]) if name in self.types else ANY
        return values_of(self._locals.get(name) or self.types.get(name))

    def _joined(self, name: str, other: Mapping[str, Interval]) -> Interval:
        """What a variable can hold here, or where `other` has come from the same start."""
        return self._of(name).join(other[name] if name in other else self._at_start(name))

    def _forget(self, node: m.Node) -> None:
        """Nothing is known of what a statement or expression writes."""
        for name in written(node):
            self._forget_name(name)
        if writes.calls_own(node):
            self._forget_called()

    def _forget_called(self) -> None:
        for name in self.called:
            self._forget_name(name)

    def _forget_name(self, name: str) -> None:
        for variable in (name, writes.own(name)):
            self._now[variable] = self._any(variable)

    # --- what conditions say --------------------------------------------------------------------

    def _assume(self, condition: m.Expression, holds: bool) -> None:
        if is_calm(condition):
            self._assumed(condition, holds)

    def _assumed(self, condition: m.Expression, holds: bool) -> None:
        match bare(condition):
            case m.Unary("!", inner):
                self._assumed(inner, not holds)
            case m.Binary("&&" | "||" as operator, left, right):
                if (operator == "&&") is holds:
                    self._assumed(left, holds)
                    self._assumed(right, holds)
            case m.Binary(operator, left, right) if operator in _COMPARES:
                sign = operator if holds else _OPPOSITE[operator]
                self._compared(left, sign, right)
                self._compared(right, _TURNED[sign], left)
            case _:
                pass

    def _compared(self, left: m.Expression, sign: str, right: m.Expression) -> None:
        if id(bare(left)) in self.cuts:
            return  # another number than that of the variable
        if not self.wraps and not self.cuts:
            left, right = writes.moved(left, right)
        name = self._variable(left) if variable_of(left) is not None else None
        if name is None or self._is_real(left) or self._is_real(right):
            return
        values = compared(self._of(name), sign, self._seen(self._value(right)))
        if values is not None:
            self._now[name] = values

    def _seen(self, values: Interval) -> Interval:
        """The numbers that a comparison sees where an expression gives some."""
        return values.in_type(INT32) if self.wraps else values

    # --- values ---------------------------------------------------------------------------------

    def _all(self, expressions: Sequence[m.Expression]) -> None:
        for expression in expressions:
            self._value(expression)

    def _value(self, expression: m.Expression) -> Interval:
        """What an expression can give; what it writes is written."""
        return self._checked(expression, self._cut(expression, self._evaluated(expression)))

    def _cut(self, expression: m.Expression, values: Interval) -> Interval:
        whole = self.cuts.get(id(expression))
        return values if whole is None else values.in_type(whole)

    def _checked(self, expression: m.Expression, values: Interval) -> Interval:
        """What an expression can give, after a look at what it must be."""
        for need in self.needs.get(id(bare(expression)), ()):
            if not need.bounds.includes(values):
                self.failed.add(need.mark)
        return values

    def _evaluated(self, expression: m.Expression) -> Interval:
        match expression:
            case m.IntLiteral(value):
                return exactly(value)
            case m.FloatLiteral():
                return ANY
            case m.BoolLiteral() | m.InstanceOf():
                return TRUTH
            case m.Name() | m.Member(m.Self()):
                return self._of(self._variable(expression) or "")
            case m.Paren(inner):
                return self._value(inner)
            case m.Assign(operator, target, value):
                return self._assigned(expression, operator, target, value)
            case m.Postfix(operator, target) | m.Unary("++" | "--" as operator, target):
                before = self._value(target)
                changed = self._assigned(expression, f"{operator[0]}=", target, m.IntLiteral(1))
                return changed if isinstance(expression, m.Unary) else before
            case m.Unary(operator, operand):
                return of_unary(operator, self._value(operand))
            case m.Cast(type_, operand):
                return self._value(operand).in_type(values_of(type_))
            case m.Choice(options):
                return self._drawn(options)
            case m.Conditional():
                return self._conditional(expression)
            case m.Binary(operator, left, right):
                return self._combined(operator, left, right)
            case m.Index(array, index, span):
                note(self.indices, span, self._value(index))
                if not is_calm(array):
                    self._value(array)
                return self._of(self._variable(array) or "")
            case m.Call(target, name, arguments, after, deadline):
                self._all([] if target is None else [target])
                self._all([e for e in (*arguments, after, deadline) if e is not None])
                if writes.calls_own(expression):
                    self._forget_called()
                return values_of(self.results.get(name))
            case _:
                return INT32

    def _drawn(self, options: Sequence[m.Expression]) -> Interval:
        """Any of some values, of which one is evaluated."""
        found = [self._value(option) for option in options]
        for option in options:
            self._forget(option)
        return reduce(Interval.join, found)

    def _conditional(self, expression: m.Conditional) -> Interval:
        if (extreme := self._extreme(expression)) is not None:
            return extreme
        self._value(expression.condition)
        before, found = dict(self._now), []
        for way, holds in ((expression.then, True), (expression.otherwise, False)):
            self._now = dict(before)
            self._assume(expression.condition, holds)
            found.append(self._value(way))
        self._now = before
        self._forget(expression)
        return found[0].join(found[1])

    def _extreme(self, expression: m.Conditional) -> Interval | None:
        """The lesser or the greater of two values, as of `a < b ? a : b`; None for others."""
        match bare(expression.condition):
            case m.Binary("<" | ">" as sign, one, other) if (
                bare(one) is bare(expression.then)
                and bare(other) is bare(expression.otherwise)
                and is_calm(expression.condition)
            ):
                self._checked(expression.condition, TRUTH)
                first, second = (self._seen(self._value(side)) for side in (one, other))
                best = min if sign == "<" else max
                return Interval(best(first.low, second.low), best(first.high, second.high))
            case _:
                return None

    def _combined(self, operator: str, left: m.Expression, right: m.Expression) -> Interval:
        first = self._value(left)
        if operator in ("&&", "||"):
            before = dict(self._now)
            self._assume(left, operator == "&&")
            self._value(right)
            self._now = before
            self._forget(right)
            return TRUTH
        second = self._value(right)
        if operator in _COMPARES:
            return TRUTH
        return self._operated(operator, (left, first), (right, second))

    def _operated(self, operator: str, left: _Operand, right: _Operand) -> Interval:
        """What an arithmetic operator gives for two operands with their values."""
        if self._is_real(left[0]) or self._is_real(right[0]):
            return ANY
        if operator == "/" and writes.calls_own(right[0]):
            return INT32  # the result may be one with a point, and less than 1
        one, other = left[1], right[1]
        if operator in _LOOKS:  # they must be an `int`, or what they look at has wrapped
            one, other = one.in_type(INT32), other.in_type(INT32)
        elif operator in _BITS:  # has wrapped, or not
            one, other = (x if INT32.includes(x) else x.join(INT32) for x in (one, other))
        return of_binary(operator, one, other)

    def _is_real(self, expression: m.Expression) -> bool:
        """Whether an expression may give a number with a point."""
        match bare(expression):
            case m.FloatLiteral() | m.Call(None, "pow" | "sqrt"):
                return True
            case m.Name() | m.Member(m.Self()) | m.Index():
                return self._of_type(self._variable(expression) or "") == ANY
            case m.Cast(type_):
                return values_of(type_) == ANY
            case m.Unary(operator, operand):
                return operator != "!" and self._is_real(operand)
            case m.Postfix(_, target) | m.Assign(_, target):
                return self._is_real(target)
            case m.Binary(operator, left, right):
                plain = operator in _COMPARES or operator in ("&&", "||")
                return not plain and (self._is_real(left) or self._is_real(right))
            case m.Conditional(_, then, otherwise):
                return self._is_real(then) or self._is_real(otherwise)
            case m.Choice(options):
                return any(map(self._is_real, options))
            case _:
                return False

    # --- writing --------------------------------------------------------------------------------

    def _assigned(
        self, whole: m.Expression, operator: str, target: m.Expression, value: m.Expression
    ) -> Interval:
        place = bare(target)
        name = self._variable(place)
        if isinstance(place, m.Index):
            self._value(place)
        earlier = self._of(name or "")
        given = self._value(value)
        before = earlier.join(self._of(name or ""))  # which of both is evaluated first
        if operator != "=":
            given = self._operated(operator[:-1], (place, before), (value, given))
            given = self._checked(whole, self._cut(whole, given))
        if name is None:
            return given
        known = self._store(name, given, writes.counts_up(operator, name, value))
        if isinstance(place, m.Index):  # other elements keep what they have
            self._now[name] = before.join(known)
        return known

    def _store(self, name: str, given: Interval, counts: bool = False) -> Interval:
        if name not in self.widths:
            whole = ANY if self.always.get(name) == ANY else self._of_type(name)
            self._now[name] = given.in_type(whole) if whole != ANY else ANY
            return self._now[name]
        whole = within_int(self.widths[name])
        if counts and self.trusts_counters and whole.low <= given.low <= whole.high < given.high:
            self.counted.add(name)
            given = Interval(given.low, whole.high)
        if not whole.includes(given):
            self.broken.add(name)
            given = whole
        self._now[name] = given
        note(self.stored, name, given)
        return given


def values_of(type_: m.Type | None) -> Interval:
    """The values of a type of the model, ANY for what is no integer; those of `int` for None."""
    if type_ is None:
        return INT32
    return TRUTH if type_.name == "boolean" else INTEGERS.get(type_.name, ANY)


def note(noted: dict[_Key, Interval], name: _Key, values: Interval) -> None:
    """Adds values that a variable has, or what else is noted."""
    noted[name] = noted[name].join(values) if name in noted else values
