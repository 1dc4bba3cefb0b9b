"""Which values the variables of bodies can have: interval analysis over statements of the model.

The abstract interpretation of Cousot and Cousot (1977): each variable has an interval, what
conditions say of one counts until it is written, and a loop is entered with nothing known of what
it writes. Numbers that hold more than the model's `int` in the code (`widths`) are taken to hold
one of it before a body starts; whatever a body gives them must be one again, or they are `broken`.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import field
from functools import reduce

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
)
from rebsync.records import dataclass
from rebsync.reverse.analysis import writes
from rebsync.reverse.analysis.needs import Mark, Need
from rebsync.reverse.analysis.writes import variable_of, written
from rebsync.reverse.bodies.building import bare, is_calm
from rebsync.reverse.bodies.cpp_ranges import fitting

_OPPOSITE = {"<": ">=", ">=": "<", ">": "<=", "<=": ">", "==": "!=", "!=": "=="}
_TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "==", "!=": "!="}
_COMPARES = frozenset(_TURNED)
_LOOKS = frozenset({"/", "%", ">>", "&", "|", "^"})


@dataclass(slots=True)
class IntervalAnalysis:
    """Follows bodies, one after the other.

    `widths` are the bits of the numbers to be looked at, by name; `types` the types of other
    variables; `known` what some names hold when a body starts, `always` what some hold at any time.
    `state` are the state variables, `called` those that functions of the class may change. `needs`
    has what must hold of expressions, by their ids. `wraps` says whether sums of the code wrap.

    `broken` are variables that may get another number than an `int` holds, `counted` those that
    only count up to one, `failed` the needs that may not hold. `stored` has all that variables of
    `widths` get, `left` what bodies leave in those of `state`.
    """

    widths: Mapping[str, int]
    types: Mapping[str, m.Type] = field(default_factory=dict)
    known: Mapping[str, Interval] = field(default_factory=dict)
    always: Mapping[str, Interval] = field(default_factory=dict)
    state: Collection[str] = ()
    called: Collection[str] = ()
    needs: Mapping[int, Sequence[Need]] = field(default_factory=dict)
    wraps: bool = True
    broken: set[str] = field(default_factory=set)
    counted: set[str] = field(default_factory=set)
    failed: set[Mark] = field(default_factory=set)
    stored: dict[str, Interval] = field(default_factory=dict)
    left: dict[str, Interval] = field(default_factory=dict)
    _now: dict[str, Interval] = field(default_factory=dict)
    _real: set[str] = field(default_factory=set)

    def body(self, statements: Sequence[m.Statement]) -> None:
        """Looks at what a body gives the numbers, and at what it leaves in state variables."""
        self._now, self._real = {}, set()
        if self._each(statements):
            self._leave()

    def _leave(self) -> None:
        for name in self.state:
            if name in self.widths:
                _note(self.left, name, self._of(name))

    # --- statements -----------------------------------------------------------------------------

    def _each(self, statements: Sequence[m.Statement]) -> bool:
        """Whether what follows may run."""
        return all(self._statement(s) for s in statements)

    def _statement(self, statement: m.Statement) -> bool:
        match statement:
            case m.Block(statements):
                return self._each(statements)
            case m.ExpressionStatement(expression):
                self._value(expression)
            case m.Local(declaration):
                self._declared(declaration)
            case m.If(condition, then, otherwise):
                return self._branches(condition, then, otherwise)
            case m.While(condition, body):
                self._loop(condition, body, ())
            case m.For():
                self._for(statement)
            case m.Switch():
                self._switch(statement)
            case m.Return(value):
                if value is not None:
                    self._value(value)
                self._leave()
                return False
            case m.Break() | m.Continue():
                return False
            case _:
                pass
        return True

    def _declared(self, declaration: m.Declaration) -> None:
        for declarator in declaration.declarators:
            initial = declarator.initial
            self._forget_name(declarator.name)
            if _of_type(declaration.type) == ANY:
                self._real.add(declarator.name)
            waiting = [initial] if initial is not None else []
            while waiting:
                value = waiting.pop()
                if isinstance(value, m.ArrayInitializer):
                    waiting += value.values
                else:
                    self._store(declarator.name, self._value(value), declaration.type)
            if declaration.type.dimensions:
                self._forget_name(declarator.name)

    def _branches(
        self, condition: m.Expression, then: m.Statement, otherwise: m.Statement | None
    ) -> bool:
        self._value(condition)
        before = dict(self._now)
        self._assume(condition, True)
        goes_on = self._statement(then)
        after, self._now = self._now, before
        self._assume(condition, False)
        others = self._statement(otherwise) if otherwise is not None else True
        if goes_on and others:
            self._now = {n: self._joined(n, after) for n in after.keys() | self._now.keys()}
        elif goes_on:
            self._now = after
        return goes_on or others

    def _joined(self, name: str, other: Mapping[str, Interval]) -> Interval:
        """What a variable can hold here, or where `other` has come from the same start."""
        return self._of(name).join(other[name] if name in other else self._at_start(name))

    def _switch(self, switch: m.Switch) -> None:
        self._value(switch.subject)
        self._forget(switch)
        before = dict(self._now)
        for case in switch.cases:
            self._now = dict(before)
            self._each(case.statements)
        self._now = before

    def _for(self, loop: m.For) -> None:
        if (rounds := writes.rounds_of(loop)) is not None:
            name, numbers = rounds
            for number in numbers:
                self._now[name] = exactly(number)
                self._statement(loop.body)
            return
        if isinstance(loop.initial, m.Declaration):
            self._declared(loop.initial)
        else:
            self._all(loop.initial)
        self._loop(loop.condition, loop.body, loop.updates)

    def _loop(
        self, condition: m.Expression | None, body: m.Statement, updates: Sequence[m.Expression]
    ) -> None:
        """One round stands for all: of what it writes nothing is known when it starts."""
        for node in (condition, body, *updates):
            if node is not None:
                self._forget(node)
        before = dict(self._now)
        if condition is not None:
            self._value(condition)
            self._assume(condition, True)
        self._statement(body)
        if updates:
            # A `continue` leads here as well: only what the condition says of others still holds.
            self._forget(body)
            if condition is not None and self._is_steady(condition, body):
                self._assume(condition, True)
            self._all(updates)
        self._now = before
        if condition is not None:
            self._value(condition)
            if not any(isinstance(n, m.Break) for n in m.walk(body)):
                self._assume(condition, False)

    def _is_steady(self, condition: m.Expression, body: m.Statement) -> bool:
        """Whether a body changes nothing of what a condition names."""
        names = {n.name for n in m.walk(condition) if isinstance(n, m.Name | m.Member)}
        changed = written(body) | (set(self.called) if writes.calls_own(body) else set())
        return not names & changed

    def _forget(self, node: m.Node) -> None:
        for name in written(node):
            self._forget_name(name)
        if writes.calls_own(node):
            self._forget_called()

    def _forget_called(self) -> None:
        for name in self.called:
            self._forget_name(name)

    def _forget_name(self, name: str) -> None:
        self._now[name] = self._any(name)

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
        if not self.wraps:
            left, right = writes.moved(left, right)
        if (name := variable_of(left)) is None or name in self._real:
            return
        if name in self.types and _of_type(self.types[name]) == ANY:
            return
        values = compared(self._of(name), sign, self._value(right).in_type(INT32))
        if values is not None:
            self._now[name] = values

    # --- values ---------------------------------------------------------------------------------

    def _of(self, name: str) -> Interval:
        return self._now[name] if name in self._now else self._at_start(name)

    def _at_start(self, name: str) -> Interval:
        return self.known[name] if name in self.known else self._any(name)

    def _any(self, name: str) -> Interval:
        if name in self.always:
            return self.always[name]
        if name in self.widths:
            return fitting(self.widths[name])
        return _of_type(self.types.get(name))

    def _all(self, expressions: Sequence[m.Expression]) -> None:
        for expression in expressions:
            self._value(expression)

    def _value(self, expression: m.Expression) -> Interval:
        """What an expression can give; what it writes is written."""
        found = self._evaluated(expression)
        for need in self.needs.get(id(bare(expression)), ()):
            if not need.bounds.includes(found):
                self.failed.add(need.mark)
        return found

    def _evaluated(self, expression: m.Expression) -> Interval:
        match expression:
            case m.IntLiteral(value):
                return exactly(value)
            case m.BoolLiteral() | m.InstanceOf():
                return TRUTH
            case m.Name(name) | m.Member(m.Self(), name):
                return self._of(name)
            case m.Paren(inner):
                return self._value(inner)
            case m.Assign(operator, target, value):
                return self._assigned(operator, target, value)
            case m.Postfix(operator, target) | m.Unary("++" | "--" as operator, target):
                before = self._value(target)
                changed = self._assigned(f"{operator[0]}=", target, m.IntLiteral(1))
                return changed if isinstance(expression, m.Unary) else before
            case m.Unary(operator, operand):
                return of_unary(operator, self._value(operand))
            case m.Cast(type_, operand):
                return self._value(operand).in_type(_of_type(type_))
            case m.Choice(options):
                return _join([self._value(option) for option in options])
            case m.Conditional():
                return self._conditional(expression)
            case m.Binary(operator, left, right):
                return self._combined(operator, left, right)
            case m.Index(array, index):
                self._value(index)
                return self._of(variable_of(array) or "")
            case m.Call(target, _, arguments, after, deadline):
                self._all([e for e in (*arguments, after, deadline) if e is not None])
                if target is None:
                    self._forget_called()
                return INT32
            case _:
                return INT32

    def _conditional(self, expression: m.Conditional) -> Interval:
        self._value(expression.condition)
        before, found = dict(self._now), []
        for way, holds in ((expression.then, True), (expression.otherwise, False)):
            self._now = dict(before)
            self._assume(expression.condition, holds)
            found.append(self._value(way))
        self._now = before
        self._forget(expression)
        return self._extreme(expression) or _join(found)

    def _extreme(self, expression: m.Conditional) -> Interval | None:
        """The lesser or the greater of two values, as of `a < b ? a : b`; None for others."""
        match expression.condition:
            case m.Binary("<" | ">" as sign, one, other) if bare(one) is bare(
                expression.then
            ) and bare(other) is bare(expression.otherwise):
                first, second = self._evaluated(one), self._evaluated(other)
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
        if operator in _LOOKS:  # of what has wrapped
            first, second = first.in_type(INT32), second.in_type(INT32)
        return of_binary(operator, first, second)

    # --- writing --------------------------------------------------------------------------------

    def _assigned(self, operator: str, target: m.Expression, value: m.Expression) -> Interval:
        place = bare(target)
        name = variable_of(place)
        if isinstance(place, m.Index):
            self._value(place.index)
            name = variable_of(place.target)
        given = self._value(value)
        if operator != "=":
            given = of_binary(operator[:-1], self._of(name or ""), given)
        if name is None:
            return given
        before = self._of(name)
        known = self._store(
            name, given, self.types.get(name), writes.counts_up(operator, name, value)
        )
        if isinstance(place, m.Index):  # other elements keep what they have
            self._now[name] = before.join(known)
        return known

    def _store(
        self, name: str, given: Interval, type_: m.Type | None, counts: bool = False
    ) -> Interval:
        if name not in self.widths:
            self._now[name] = given.in_type(_of_type(type_))
            return self._now[name]
        whole = fitting(self.widths[name])
        if counts and whole.low <= given.low <= whole.high < given.high:
            self.counted.add(name)
            given = Interval(given.low, whole.high)
        if not whole.includes(given):
            self.broken.add(name)
            given = whole
        self._now[name] = given
        _note(self.stored, name, given)
        return given


def _of_type(type_: m.Type | None) -> Interval:
    if type_ is None:
        return INT32
    return TRUTH if type_.name == "boolean" else INTEGERS.get(type_.name, ANY)


def _join(intervals: Sequence[Interval]) -> Interval:
    return reduce(Interval.join, intervals)


def _note(noted: dict[str, Interval], name: str, values: Interval) -> None:
    noted[name] = noted[name].join(values) if name in noted else values
