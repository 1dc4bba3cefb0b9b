"""How great numbers may be, to tell those that may be infinite or none at all.

Of what messages and other functions give it is trusted that it is an ordinary number, below a bound
that whole numbers of messages have; what is computed of it may be greater.
"""

from __future__ import annotations

import math

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import CallResult, Key, Stored, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import COMPARISONS, Operator

_ORDINARY = 2.0**64
_GREATEST = 1024  # the power of two that no float holds
_DIVIDING = (Operator.TRUE_DIVIDE, Operator.CLASSIC_DIVIDE, Operator.FLOOR_DIVIDE)
_INFINITE = frozenset({"math.inf", "math.nan", "numpy.inf", "numpy.nan"})


class Magnitudes:
    """Numbers of one function."""

    def __init__(self, origins: Origins, function: str) -> None:
        self._origins = origins
        self._function = function
        self._known: dict[Key, float] = {}  # those on the way are ordinary ones

    def is_finite(self, value: e.Expression) -> bool:
        """Whether a number is an ordinary one, by how it and all that it is made of is computed."""
        return math.isfinite(self._of(value, self._function))

    def _of(self, value: e.Expression, function: str) -> float:
        """A bound of a number; infinite where there is none."""
        match value:
            case e.Literal(int() | float() as number):
                return abs(float(number)) if abs(number) < _ORDINARY**8 else math.inf
            case e.LibraryReference(name):
                return math.inf if name in _INFINITE else _ORDINARY
            case e.Unary(_, operand) | e.Convert(_, operand):
                return self._of(operand, function)
            case e.Conditional(_, one, other) | e.And(one, other) | e.Or(one, other):
                return max(self._of(one, function), self._of(other, function))
            case e.Binary(operator, left, right):
                bounds = self._of(left, function), self._of(right, function)
                return _combined(operator, *bounds, right)
        key = key_of(value, function)
        if key is None:
            return _ORDINARY
        if key not in self._known:
            self._known[key] = _ORDINARY
            stored = self._origins.graph.stores.of(key)
            self._known[key] = max(map(self._of_stored, stored), default=_ORDINARY)
        return self._known[key]

    def _of_stored(self, stored: Stored) -> float:
        function, value = stored
        match value:
            case CallResult(call):
                return self._of_call(call, function)
            case _ if isinstance(value, e.Binary | e.Literal | e.Unary | e.Conditional | e.Convert):
                return self._of(value, function)
            case e.Temporary() | e.Local() | e.Global() | e.Captured() | e.LibraryReference():
                return self._of(value, function)
            case _:
                return _ORDINARY

    def _of_call(self, call: s.Call, function: str) -> float:
        """A bound of what a call gives: it is ordinary if all that it gets is."""
        if not isinstance(call.callee, s.LibraryCallee):
            return _ORDINARY
        values = [a.value for a in call.arguments]
        if call.callee.name == "builtins.float" and any(map(_is_text, values)):
            return math.inf
        bounds = (self._of(value, function) for value in values)
        return _ORDINARY if all(map(math.isfinite, bounds)) else math.inf


def _is_text(value: e.Expression) -> bool:
    return isinstance(value, e.Literal) and isinstance(value.value, str)


def _combined(operator: Operator, left: float, right: float, by: e.Expression) -> float:
    """A bound of what an operator gives, of those of its operands."""
    if not (math.isfinite(left) and math.isfinite(right)):
        return 1.0 if operator in COMPARISONS else math.inf
    match operator:
        case Operator.ADD | Operator.SUBTRACT:
            return left + right
        case Operator.MULTIPLY:
            return left * right
        case _ if operator in COMPARISONS:
            return 1.0
        case _ if operator in _DIVIDING:
            is_written = isinstance(by, e.Literal) and right
            return left / right if is_written else left * _ORDINARY
        case Operator.POWER:
            is_small = right * math.log2(max(left, 1.0)) < _GREATEST
            return max(left, 1.0) ** right if isinstance(by, e.Literal) and is_small else math.inf
        case _:
            return max(left, right)
