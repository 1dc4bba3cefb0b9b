"""Which wide numbers of bodies always are such that the model's `int` holds them.

Each is taken to hold such a number before a body starts; whatever a body gives it must be one
again. That is seen from intervals: what conditions say of a variable counts until it is written.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import field
from typing import TypeAlias

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.building import bare, is_calm
from rebsync.reverse.bodies.cpp_ranges import combined, fitting

Interval: TypeAlias = tuple[int, int]
ANY: Interval = (-(1 << 65), 1 << 65)
_TRUTH: Interval = (0, 1)
_BITS = {"byte": 7, "short": 15, "int": 31}
_STEP = 1 << 16  # what a counter may count by: it takes long to get out of an `int`
_OPPOSITE = {"<": ">=", ">=": "<", ">": "<=", "<=": ">", "==": "!=", "!=": "=="}
_TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "==", "!=": "!="}
_COMPARES = frozenset(_TURNED)
_LOOKS = frozenset({"/", "%", ">>", "&", "|", "^"})
_INT = m.Type("int")


@dataclass(slots=True)
class Proof:
    """Follows bodies. `wide` are bits of the numbers to be looked at, by name; `types` those of
    other variables; `state` what methods may change; `known` what some names always are.

    `broken` are those that may get another number, `counted` those that only count up to one.
    """

    wide: Mapping[str, int]
    types: Mapping[str, m.Type] = field(default_factory=dict)
    state: Collection[str] = ()
    known: Mapping[str, Interval] = field(default_factory=dict)
    broken: set[str] = field(default_factory=set)
    counted: set[str] = field(default_factory=set)
    _now: dict[str, Interval] = field(default_factory=dict)
    _real: set[str] = field(default_factory=set)

    def body(self, statements: Sequence[m.Statement]) -> None:
        """Looks at what a body gives the numbers."""
        self._now, self._real = {}, set()
        self._each(statements)

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
            case m.For(initial, condition, updates, body):
                if isinstance(initial, m.Declaration):
                    self._declared(initial)
                else:
                    self._all(initial)
                self._loop(condition, body, updates)
            case m.Switch(subject, cases):
                self._value(subject)
                self._forget(statement)
                before = dict(self._now)
                for case in cases:
                    self._now = dict(before)
                    self._each(case.statements)
                self._now = before
            case m.Return(value):
                if value is not None:
                    self._value(value)
                return False
            case m.Break() | m.Continue():
                return False
            case _:
                pass
        return True

    def _declared(self, declaration: m.Declaration) -> None:
        for declarator in declaration.declarators:
            initial = declarator.initial
            self._now.pop(declarator.name, None)
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
                self._now.pop(declarator.name, None)

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
            self._now = {n: _joined(self._of(n), after[n]) for n in after if n in self._now}
        elif goes_on:
            self._now = after
        return goes_on or others

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
        calls = any(isinstance(n, m.Call) and n.target is None for n in m.walk(body))
        return not names & _written(body) and not (calls and names & set(self.state))

    def _forget(self, node: m.Node) -> None:
        for name in _written(node):
            self._now.pop(name, None)
        if any(isinstance(n, m.Call) and n.target is None for n in m.walk(node)):
            self._forget_state()

    def _forget_state(self) -> None:
        for name in self.state:
            self._now.pop(name, None)

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
        if (name := _name(left)) is None or name in self._real:
            return
        if name in self.types and _of_type(self.types[name]) == ANY:
            return
        (low, high), (least, most) = self._of(name), _clipped(self._value(right), _INT)
        match sign:
            case "<":
                high = min(high, most - 1)
            case "<=":
                high = min(high, most)
            case ">":
                low = max(low, least + 1)
            case ">=":
                low = max(low, least)
            case "==":
                low, high = max(low, least), min(high, most)
            case "!=" if least == most:
                low, high = low + (low == least), high - (high == least)
        if low <= high:
            self._now[name] = low, high

    # --- values ---------------------------------------------------------------------------------

    def _of(self, name: str) -> Interval:
        if name in self._now:
            return self._now[name]
        if name in self.known:
            return self.known[name]
        if name in self.wide:
            whole = fitting(self.wide[name])
            return whole.low, whole.high
        return _of_type(self.types.get(name))

    def _all(self, expressions: Sequence[m.Expression]) -> None:
        for expression in expressions:
            self._value(expression)

    def _value(self, expression: m.Expression) -> Interval:
        """What an expression can give; what it writes is written."""
        match expression:
            case m.IntLiteral(value):
                return value, value
            case m.BoolLiteral() | m.InstanceOf():
                return _TRUTH
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
                low, high = self._value(operand)
                signs = {"-": (-high, -low), "~": (~high, ~low), "!": _TRUTH, "+": (low, high)}
                return signs.get(operator, ANY)
            case m.Cast(type_, operand):
                return _clipped(self._value(operand), type_)
            case m.Conditional() | m.Choice():
                return self._alternatives(expression)
            case m.Binary(operator, left, right):
                return self._combined(operator, left, right)
            case m.Index(array, index):
                self._value(index)
                name = _name(array) or ""
                return self._of(name)
            case m.Call(target, _, arguments, after, deadline):
                self._all([e for e in (*arguments, after, deadline) if e is not None])
                if target is None:
                    self._forget_state()
                return _of_type(m.Type("int"))
            case _:
                return _of_type(m.Type("int"))

    def _alternatives(self, expression: m.Conditional | m.Choice) -> Interval:
        if isinstance(expression, m.Choice):
            found = [self._value(option) for option in expression.options]
        else:
            self._value(expression.condition)
            before, found = dict(self._now), []
            for way, holds in ((expression.then, True), (expression.otherwise, False)):
                self._now = dict(before)
                self._assume(expression.condition, holds)
                found.append(self._value(way))
            self._now = before
            self._forget(expression)
        return min(f[0] for f in found), max(f[1] for f in found)

    def _combined(self, operator: str, left: m.Expression, right: m.Expression) -> Interval:
        first = self._value(left)
        if operator in ("&&", "||"):
            before = dict(self._now)
            self._assume(left, operator == "&&")
            self._value(right)
            self._now = before
            self._forget(right)
            return _TRUTH
        second = self._value(right)
        if operator in _COMPARES:
            return _TRUTH
        if operator in _LOOKS:  # of what has wrapped
            first, second = _clipped(first, _INT), _clipped(second, _INT)
        return combined(operator, first, second)

    # --- writing --------------------------------------------------------------------------------

    def _assigned(self, operator: str, target: m.Expression, value: m.Expression) -> Interval:
        place = bare(target)
        name = _name(place)
        if isinstance(place, m.Index):
            self._value(place.index)
            name = _name(place.target)
        given = self._value(value)
        if operator != "=":
            given = combined(operator[:-1], self._of(name or ""), given)
        if name is None:
            return given
        counts = _counts(operator, name, value)
        known = self._store(name, given, self.types.get(name), counts)
        if isinstance(place, m.Index):
            self._now.pop(name, None)
        return known

    def _store(
        self, name: str, given: Interval, type_: m.Type | None, counts: bool = False
    ) -> Interval:
        if name not in self.wide:
            self._now[name] = _clipped(given, type_)
            return self._now[name]
        whole = fitting(self.wide[name])
        low, high = given
        if counts and whole.low <= low <= whole.high < high:
            self.counted.add(name)
            high = whole.high
        if low < whole.low or high > whole.high:
            self.broken.add(name)
            low, high = whole.low, whole.high
        self._now[name] = low, high
        return low, high


def _counts(operator: str, name: str, value: m.Expression) -> bool:
    """Whether a variable gets little more than it has."""
    match operator, bare(value):
        case "+=", m.IntLiteral(step):
            return 0 < step <= _STEP
        case "=", m.Binary("+", left, m.IntLiteral(step)):
            return _name(left) == name and 0 < step <= _STEP
        case _:
            return False


def _name(expression: m.Expression) -> str | None:
    match bare(expression):
        case m.Name(name) | m.Member(m.Self(), name):
            return name
        case _:
            return None


def _written(node: m.Node) -> set[str]:
    found = set()
    for inner in m.walk(node):
        match inner:
            case m.Assign(_, target) | m.Postfix(_, target) | m.Unary("++" | "--", target):
                place = bare(target)
                whole = place.target if isinstance(place, m.Index) else place
                found.add(_name(whole) or "")
            case m.Declarator(name):
                found.add(name)
            case _:
                pass
    return found


def _of_type(type_: m.Type | None) -> Interval:
    if type_ is not None and type_.name == "boolean":
        return _TRUTH
    bits = _BITS.get(type_.name if type_ is not None else "int")
    return (-(1 << bits), (1 << bits) - 1) if bits is not None else ANY


def _clipped(found: Interval, type_: m.Type | None) -> Interval:
    """What a type has of some values: all of its own where they do not fit."""
    whole = _of_type(type_)
    return found if whole[0] <= found[0] and found[1] <= whole[1] else whole


def _joined(first: Interval, second: Interval) -> Interval:
    return min(first[0], second[0]), max(first[1], second[1])
