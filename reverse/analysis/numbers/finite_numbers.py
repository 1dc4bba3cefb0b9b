"""Which values are finite numbers, and between which limits they are, whenever that is asked.

By all that is ever stored under a name, and by the types that C++ declares.
"""

from __future__ import annotations

import math
from functools import reduce

from rebsync.intervals import TRUTH, Interval, exactly, of_unary, signed, unsigned
from rebsync.records import dataclass
from rebsync.reverse.analysis.held_values import is_own
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import (
    AnyValue,
    CallResult,
    ClassValue,
    Key,
    ObjectValue,
    Stored,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.libraries.outcome_rules import Tells
from rebsync.reverse.libraries.outcomes import LibraryOutcomes

# A size is no greater than the memory: counters of 32 bits get to any, and some way further.
_SIZES = Interval(0, (1 << 31) - (1 << 16))
_WHOLE = frozenset(
    {
        *(Operator.ADD, Operator.SUBTRACT, Operator.MULTIPLY, Operator.FLOOR_DIVIDE),
        *(Operator.FLOOR_MODULO, Operator.SHIFT_LEFT, Operator.SHIFT_RIGHT),
        *(Operator.BIT_AND, Operator.BIT_OR, Operator.BIT_XOR),
        *(Operator.TRUNCATING_DIVIDE, Operator.TRUNCATING_REMAINDER),
    }
)
_GIVING_WHOLE = frozenset(
    {
        *("builtins.int", "builtins.ord", "builtins.hash", "builtins.bool", "time.time_ns"),
        *("math.floor", "math.ceil", "math.trunc", "random.randint", "time.monotonic_ns"),
    }
)
_CHOOSING = frozenset({"builtins.abs", "builtins.min", "builtins.max"})


@dataclass(frozen=True, slots=True)
class Limits:
    """A finite number, which is within an interval where one is known."""

    within: Interval | None = None
    is_whole: bool = True


_ANY_WHOLE = Limits()


class FiniteNumbers:
    """The numbers of one program."""

    def __init__(self, origins: Origins, table: LibraryOutcomes) -> None:
        self.origins = origins
        self.graph = origins.graph
        self.table = table

    def limits(self, value: e.Expression, function: str) -> Limits | None:
        """The limits of a value in a function; None if it may be infinite, or no number."""
        return self._limits(value, function, frozenset())

    def _limits(self, value: e.Expression, function: str, within: frozenset[Key]) -> Limits | None:
        match value:
            case e.Literal(int() as number):
                return Limits(exactly(number))
            case e.Literal(float() as number):
                if not math.isfinite(number):
                    return None
                return Limits(Interval(math.floor(number), math.ceil(number)), False)
            case e.Convert(_, operand, type_):
                return _converted(self._limits(operand, function, within), type_)
            case e.Unary(Operator.NEGATE, operand, t.Unknown()):
                return _negated(self._limits(operand, function, within))
            case e.Conditional(_, one, other) | e.And(one, other) | e.Or(one, other):
                parts = (self._limits(p, function, within) for p in (one, other))
                return _either(*parts)
            case e.Binary(operator, left, right, type_):
                if not isinstance(type_, t.Unknown):
                    return _of_type(type_, operator)
                if operator not in _WHOLE:
                    return None
                known = [self._limits(p, function, within) for p in (left, right)]
                is_whole = all(p is not None and p.is_whole for p in known)
                return _ANY_WHOLE if is_whole else None
            case _:
                of_type = _of_type(getattr(value, "type", t.UNKNOWN))
                stored = self._stored(value, function, within)
                has_limits = stored is not None and stored.within is not None
                return stored if of_type is None or has_limits else of_type

    def _stored(self, value: e.Expression, function: str, within: frozenset[Key]) -> Limits | None:
        """The limits of all that is ever stored under a name."""
        key = key_of(value, function)
        if key is None:
            return None
        if isinstance(value, e.Attribute):
            # The types of C++ say more than what is stored is known to.
            is_typed = not isinstance(value.type, t.Unknown)
            if is_typed or not is_own(self.origins, value.object, function):
                return None
        if key in within:
            return _ANY_WHOLE  # Only what is stored besides counts.
        changed = self.graph.stores.changed(key)
        known = self.graph.stores.initial(key) + changed
        found = [self._of_stored(each, within | {key}) for each in known]
        whole = _either(*found)
        # What is computed from itself has no limits that its first values say.
        if whole is not None and (changed or any(f == _ANY_WHOLE for f in found)):
            return _ANY_WHOLE if whole.is_whole else None
        return whole

    def _of_stored(self, stored: Stored, within: frozenset[Key]) -> Limits | None:
        function, value = stored
        match value:
            case CallResult(call):
                return self._of_call(call, function, within)
            case AnyValue() | ClassValue() | ObjectValue():
                return None
            case _:
                return self._limits(value, function, within)

    def _of_call(self, call: s.Call, function: str, within: frozenset[Key]) -> Limits | None:
        values = [a.value for a in call.arguments if a.name is None and not a.stars]
        match call.callee:
            case s.LibraryCallee(name):
                is_size = self.table.function(name).tells is Tells.SIZE
            case s.MethodCallee(_, name, None):
                is_size = self.table.method(None, name).tells is Tells.SIZE
            case _:
                return None if call.target is None else _of_type(call.target.type)
        if is_size:
            return Limits(_SIZES)
        if name in _GIVING_WHOLE or (name == "builtins.round" and len(call.arguments) == 1):
            return _ANY_WHOLE
        if name in _CHOOSING and len(values) == len(call.arguments):
            known = [self._limits(v, function, within) for v in values]
            is_whole = all(k is not None and k.is_whole for k in known)
            return _ANY_WHOLE if is_whole and (known[1:] or name == "builtins.abs") else None
        return None if call.target is None else _of_type(call.target.type)


def _of_type(type_: t.Type, operator: Operator | None = None) -> Limits | None:
    """The limits that a type has; of a difference without a sign, none that are ever reached."""
    if isinstance(type_, t.Truth):
        return Limits(TRUTH)
    if not isinstance(type_, t.Integer):
        return None
    if type_.bits is None:
        return _ANY_WHOLE
    if operator is Operator.SUBTRACT and type_.bits == 64 and not type_.signed:
        return None
    return Limits(values_of(type_))


def values_of(type_: t.Integer) -> Interval:
    """The numbers of a type with bounds."""
    assert type_.bits is not None
    return signed(type_.bits - 1) if type_.signed else unsigned(type_.bits)


def _converted(limits: Limits | None, type_: t.Type) -> Limits | None:
    of_type = _of_type(type_)
    if of_type is None:
        return limits if isinstance(type_, t.Float) else None
    if limits is None or limits.within is None or of_type.within is None:
        return of_type
    if of_type.within.includes(limits.within):
        return limits
    # A negative number that becomes one of 64 bits without a sign is beyond all counting.
    is_huge = isinstance(type_, t.Integer) and type_.bits == 64 and not type_.signed
    return None if is_huge and limits.within.low < 0 else of_type


def _negated(limits: Limits | None) -> Limits | None:
    if limits is None or limits.within is None:
        return limits
    return Limits(of_unary("-", limits.within), limits.is_whole)


def _either(*limits: Limits | None) -> Limits | None:
    """The limits of a value that is one of several."""
    known = [each for each in limits if each is not None]
    if not known or len(known) < len(limits):
        return None
    bounds = [each.within for each in known if each.within is not None]
    within = reduce(Interval.join, bounds) if len(bounds) == len(known) else None
    return Limits(within, all(each.is_whole for each in known))
