"""Which operations on times of client libraries throw: other clocks, moments before the first one.

Each value is looked at by all that is stored in what it names: whether it is a moment or the time
between two, of which clock, and whether it is surely not negative.
"""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.records import dataclass
from rebsync.reverse.analysis.numbers.source_numbers import SourceNumbers
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import AnyValue, CallResult, Key, Stored, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import COMPARISONS, Operator
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries import client_times as table
from rebsync.reverse.libraries.client_times import TIME_CLASSES, TimeUse

_ANY_CLOCK = ""


@dataclass(frozen=True, slots=True)
class TimeKind:
    """A value of a class of times: its clock, and whether it is surely not negative."""

    of: str
    clock: str = _ANY_CLOCK
    is_forward: bool = False

    @property
    def is_point(self) -> bool:
        """Whether it is a moment."""
        return TIME_CLASSES[self.of].use is TimeUse.POINT

    @property
    def knows_clocks(self) -> bool:
        """Whether its library tells clocks apart."""
        return TIME_CLASSES[self.of].knows_clocks


_Kinds = frozenset[TimeKind]
_NONE: _Kinds = frozenset()
_STAMP = frozenset(TimeKind(of, table.OWN_CLOCK) for of in table.STAMP_CLASSES)
_LANGUAGE_SPAN = TimeKind(table.LANGUAGE_SPAN)


class ClientTimes:
    """The times of one program; what is no time, or perhaps none, has no kinds."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins
        self._stores = origins.graph.stores
        self._program = origins.graph.program
        self._numbers = SourceNumbers(origins)

    def may_throw(self, value: e.Binary, function: str) -> bool:
        """Whether an operator throws for some values that its operands may have."""
        left, right = (self.of(v, function) for v in (value.left, value.right))
        if not left | right:
            return False
        if value.operator is Operator.MULTIPLY:
            factors = [v for v, k in ((value.left, left), (value.right, right)) if not k]
            return not all(self._numbers.of(v, function) for v in factors)
        sides = [{kind.knows_clocks for kind in kinds} for kinds in (left, right) if kinds]
        known = set.intersection(*sides)  # a stamp is of the library of what it is used with
        return any(_throws(value.operator, left, right, k) for k in known)

    # --- what a value is -------------------------------------------------------------------------

    def of(self, value: e.Expression, function: str) -> _Kinds:
        """The kinds of times that a value may be."""
        return self._of(value, function, frozenset()) or _NONE

    def _of(self, value: e.Expression, function: str, within: frozenset[Key]) -> _Kinds | None:
        """The same; None where that depends on nothing but what is asked for already."""
        match value:
            case e.Copy(operand) | e.Move(operand) | e.Convert(_, operand):
                found = self._of(operand, function, within)
                return _of_type(value) if found == _NONE else found
            case e.Dereference(operand) | e.AddressOf(operand):
                found = self._of(operand, function, within)
                return _of_type(value) if found == _NONE else found
            case e.Conditional(_, one, other):
                return _either(self._of(v, function, within) for v in (one, other))
            case e.Unary(Operator.NEGATE, operand):
                found = self._of(operand, function, within)
                return found and frozenset(TimeKind(k.of, k.clock) for k in found)
            case e.Binary(operator, left, right):
                first, second = (self._of(v, function, within) for v in (left, right))
                return None if first is None else _computed(operator, first, second or _NONE)
            case e.Attribute(_, name) if name in table.STAMPS and not _of_type(value):
                return _STAMP
        key = key_of(value, function)
        if key is None:
            return _of_type(value)
        return None if key in within else self._stored(value, key, within | {key})

    def _stored(self, value: e.Expression, key: Key, within: frozenset[Key]) -> _Kinds | None:
        """The kinds of all that is ever stored under a name; of its type if that is not known."""
        facts = self._origins.of_cpp
        first, changed = self._stores.initial(key), self._stores.changed(key)
        stored = [v for v in first if not isinstance(v[1], AnyValue)]
        unknown = len(first) - len(stored)
        if unknown > facts.unchanging_addresses.get(key, 0):
            return _of_type(value)
        stored += [*changed, *facts.stored_through.get(key, [])]
        if any(self._is_set_at_start(key, each) for each in stored):
            stored = [v for v in stored if not _is_default(v[1])]
        found = [self._of_stored(each, within) for each in stored]
        known = _either(found) if found else _NONE
        return _of_type(value) if known == _NONE else known

    def _is_set_at_start(self, key: Key, stored: Stored) -> bool:
        """Whether a constructor surely stores something besides what a member starts with."""
        function, value = stored
        if _is_default(value) or function not in self._origins.of_cpp.constructing:
            return False
        body = self._program.function(function)
        return any(_stores(n, value, key, function) for n in _surely_run(body.body))

    def _of_stored(self, stored: Stored, within: frozenset[Key]) -> _Kinds | None:
        function, value = stored
        match value:
            case CallResult(call):
                return self._result(call, function, within)
            case _ if isinstance(value, e.Expression):
                return self._of(value, function, within)
            case _:
                return _NONE

    def _result(self, call: s.Call, function: str, within: frozenset[Key]) -> _Kinds | None:
        """The kinds of what a call gives."""
        match call.callee:
            case s.LibraryCallee(name, receiver):
                return self._of_library(call, name, receiver, function, within)
            case s.MethodCallee(receiver, "now"):
                return self._now(receiver, function)
            case s.FunctionCallee(name) if name in self._program:
                returned = map(_returned, walk(self._program.function(name)))
                found = [self._of(v, name, within) for v in returned if v is not None]
                known = _either(found) if found else _NONE
                return _of_type(call.target) if known == _NONE else known
            case _:
                return _NONE

    def _of_library(
        self,
        call: s.Call,
        name: str,
        receiver: e.Expression | None,
        function: str,
        within: frozenset[Key],
    ) -> _Kinds | None:
        name = name.removeprefix("::").removeprefix("new ")
        class_, _, last = name.rpartition("::")
        values = [a.value for a in call.arguments]
        if name in table.NOW_OF_NODE:
            return frozenset({TimeKind(table.STAMP_CLASSES[-1], table.OWN_CLOCK)})
        if class_ == table.CLOCK_CLASS and last == "now" and receiver is not None:
            return self._now(receiver, function)
        if class_ in TIME_CLASSES and last == "now":
            return frozenset({TimeKind(class_)})
        if name.startswith(table.OF_THE_LANGUAGE):
            return frozenset({_LANGUAGE_SPAN})
        if class_ in TIME_CLASSES and last == "fromSec":
            return frozenset({TimeKind(class_)})
        made = table.MAKING.get(name, name)
        if made not in TIME_CLASSES:
            return _NONE
        if TIME_CLASSES[made].use is TimeUse.SPAN:
            is_forward = all(self._is_forward(v, function) for v in values)
            return frozenset({TimeKind(made, is_forward=is_forward)})
        return self._point(made, values, function, within)

    def _is_forward(self, value: e.Expression, function: str) -> bool:
        numbers = self._numbers.of(value, function)
        return bool(numbers) and all(n >= 0 for n in numbers)

    # --- clocks ----------------------------------------------------------------------------------

    def _point(
        self, of: str, values: list[e.Expression], function: str, within: frozenset[Key]
    ) -> _Kinds | None:
        """A moment that is made of some values."""
        if not TIME_CLASSES[of].knows_clocks:
            return frozenset({TimeKind(of)})
        for value in values:
            if (clock := self._named_clock(value, function)) is not None:
                return frozenset({TimeKind(of, clock)})
        if all(self._numbers.is_number(value, function) for value in values):
            return frozenset({TimeKind(of, table.DEFAULT_CLOCK)})
        found = self._of(values[0], function, within)
        if found is None:
            return None
        return frozenset(k for k in found if k.of == of) or frozenset({TimeKind(of)})

    def _named_clock(self, value: e.Expression, function: str) -> str | None:
        """The clock that an argument names, or asks for."""
        for node in walk(value):
            match node:
                case e.Attribute(name=name) | e.Global(name=name) | e.LibraryReference(name):
                    if name.rpartition("::")[2] in table.CLOCKS:
                        return name.rpartition("::")[2]
                case _:
                    pass
        for call in self._calls_giving(value, function):
            match call.callee:
                case s.MethodCallee(receiver, name) | s.LibraryCallee(name, receiver):
                    if receiver is not None and name.endswith(table.ASKING_CLOCK):
                        return self._clock(receiver, function)
                case _:
                    pass
        return None

    def _now(self, receiver: e.Expression, function: str) -> _Kinds:
        clock = self._clock(receiver, function)
        return frozenset({TimeKind(table.STAMP_CLASSES[-1], clock)})

    def _clock(self, clock: e.Expression, function: str) -> str:
        """The clock of an object that is one, or that has one as nodes do."""
        made = [c for c in self._calls_giving(clock, function) if _makes_clock(c)]
        if not made:
            is_other = _is_clock(clock) and not self._is_asked(clock, function)
            return _ANY_CLOCK if is_other else table.OWN_CLOCK
        if len(made) > 1 or self._is_asked(clock, function):
            return _ANY_CLOCK
        values = [a.value for a in made[0].arguments]
        named = [self._named_clock(value, function) for value in values]
        return table.DEFAULT_CLOCK if not named else named[0] or _ANY_CLOCK

    def _is_asked(self, clock: e.Expression, function: str) -> bool:
        """Whether a clock is one that a node is asked for."""
        calls = self._calls_giving(clock, function)
        names = (getattr(c.callee, "name", "") for c in calls)
        return any(name.rpartition("::")[2] == "get_clock" for name in names)

    def _calls_giving(self, value: e.Expression, function: str) -> list[s.Call]:
        """The calls whose results a variable holds."""
        while isinstance(value, e.Dereference | e.AddressOf | e.Convert | e.Copy):
            value = parts_of(value)
        key = key_of(value, function)
        stored = [] if key is None else self._stores.of(key)
        return [v.call for _, v in stored if isinstance(v, CallResult)]


def parts_of(value: e.Dereference | e.AddressOf | e.Convert | e.Copy) -> e.Expression:
    """What a value is made of that stands for another one."""
    match value:
        case e.Dereference(of) | e.AddressOf(of) | e.Convert(_, of) | e.Copy(of):
            return of


def _makes_clock(call: s.Call) -> bool:
    name = getattr(call.callee, "name", "")
    return isinstance(call.callee, s.LibraryCallee) and table.CLOCK_CLASS in (
        name,
        name.removeprefix("new "),
    )


def _is_clock(value: e.Expression) -> bool:
    """Whether a value is a clock, or leads to one, by its type."""
    type_ = getattr(value, "type", t.UNKNOWN)
    while isinstance(type_, t.Reference):
        type_ = type_.to
    return isinstance(type_, t.Record) and type_.name.partition("<")[0].startswith(
        table.CLOCK_CLASS
    )


def _surely_run(body: s.Body) -> Iterable[s.Statement]:
    """The statements of a body that run whenever it comes to its end."""
    for statement in body:
        yield statement
        match statement:
            case s.Block(inner) | s.Try(inner):
                yield from _surely_run(inner)
            case _:
                pass


def _stores(node: s.Statement, value: object, key: Key, function: str) -> bool:
    """Whether a statement stores a value under a name."""
    match node:
        case s.Assign(target, stored):
            return stored is value and key_of(target, function) == key
        case s.Call(target) if target is not None:
            is_same = isinstance(value, CallResult) and value.call is node
            return is_same and key_of(target, function) == key
        case _:
            return False


def _is_default(value: object) -> bool:
    """Whether a value is what a time starts with that nothing is given to."""
    match value:
        case CallResult(s.Call(_, s.LibraryCallee(name), ())):
            return name in TIME_CLASSES
        case _:
            return False


def _returned(node: object) -> e.Expression | None:
    return node.value if isinstance(node, s.Return) else None


def _of_type(value: object) -> _Kinds:
    """The kinds that the type of a value says."""
    type_ = getattr(value, "type", t.UNKNOWN)
    while isinstance(type_, t.Reference):
        type_ = type_.to
    is_time = isinstance(type_, t.Record) and type_.name in TIME_CLASSES
    return frozenset({TimeKind(type_.name)}) if is_time else _NONE  # type: ignore[union-attr]


def _either(found: Iterable[_Kinds | None]) -> _Kinds | None:
    """The kinds of what is one of several; none where one of them has none."""
    known = [kinds for kinds in found if kinds is not None]
    if not known:
        return None
    return frozenset[TimeKind]().union(*known) if all(known) else _NONE


def _computed(operator: Operator, left: _Kinds, right: _Kinds) -> _Kinds:
    """The kinds of a sum, difference or product."""
    match operator:
        case Operator.ADD if any(k.is_point for k in right) and left:
            return _computed(operator, right, left) if not any(k.is_point for k in left) else _NONE
        case Operator.ADD | Operator.SUBTRACT if left and right and all(k.is_point for k in left):
            points = frozenset(k for k in left if any(not r.is_point for r in right))
            spans = {_span_of(k) for k in left if any(r.is_point for r in right)}
            return points | spans
        case Operator.ADD if left and right:
            is_forward = all(k.is_forward for k in left | right)
            return frozenset(TimeKind(k.of, is_forward=is_forward) for k in left)
        case Operator.SUBTRACT | Operator.MULTIPLY if left and not any(k.is_point for k in left):
            return frozenset(TimeKind(k.of) for k in left)
        case Operator.MULTIPLY if right:
            return frozenset(TimeKind(k.of) for k in right)
        case _:
            return _NONE


def _span_of(point: TimeKind) -> TimeKind:
    """The kind of the time between two moments."""
    spans = (c for c, k in TIME_CLASSES.items() if k.use is TimeUse.SPAN)
    return TimeKind(next(c for c in spans if TIME_CLASSES[c].knows_clocks == point.knows_clocks))


def _of_library(kinds: _Kinds, knows_clocks: bool) -> _Kinds:
    return frozenset(k for k in kinds if k.knows_clocks is knows_clocks)


def _throws(operator: Operator, left: _Kinds, right: _Kinds, knows_clocks: bool) -> bool:
    """Whether an operator throws for some values of one library."""
    first, second = (_of_library(kinds, knows_clocks) for kinds in (left, right))
    is_difference = operator is Operator.SUBTRACT
    if knows_clocks:
        return (is_difference or operator in COMPARISONS) and _differ(first, second)
    is_sum = operator is Operator.ADD
    return (is_difference or is_sum) and _leaves_range(first, second, is_sum)


def _differ(left: _Kinds, right: _Kinds) -> bool:
    """Whether two moments that are compared may be of clocks that are not the same."""
    if any(kinds and not any(k.is_point for k in kinds) for kinds in (left, right)):
        return False  # with the time between two moments
    clocks = {k.clock for k in left | right if k.is_point}
    return not (left and right) or len(clocks) > 1 or _ANY_CLOCK in clocks


def _leaves_range(left: _Kinds, right: _Kinds, is_sum: bool) -> bool:
    """Whether a sum or difference may be a moment before the first one, or after the last one."""
    if left and not any(k.is_point for k in left):
        left, right = (right, left) if is_sum else (left, right)
    if left and not any(k.is_point for k in left):
        return False  # of spans, both of which have a sign
    if not right:
        return True
    spans = [k for k in right if not k.is_point]
    return any(not k.is_forward for k in spans) if is_sum else bool(spans)
