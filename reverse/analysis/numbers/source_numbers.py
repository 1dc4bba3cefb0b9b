"""Which numbers a value of C++ may be, where all of them stand in the source."""

from __future__ import annotations

from itertools import product

from rebsync.reverse.analysis.held_values import all_held
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import AnyValue, Key, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator

_MOST = 16  # of numbers that are followed
_DIVIDING = (Operator.TRUE_DIVIDE, Operator.CLASSIC_DIVIDE)


class SourceNumbers:
    """The numbers of one program."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins

    def of(self, value: e.Expression, function: str) -> list[float]:
        """All numbers that a value may be; none where that is not known."""
        return self._of(value, function, frozenset())

    def is_number(self, value: e.Expression, function: str) -> bool:
        """Whether a value is a number, by its type or by what it is computed of."""
        of = value.target if isinstance(value, e.AddressOf) else value
        if isinstance(getattr(of, "type", None), t.Integer | t.Float):
            return True
        return bool(self.of(value, function))

    def _of(self, value: e.Expression, function: str, within: frozenset[Key]) -> list[float]:
        match value:
            case e.Literal(bool()):
                return []
            case e.Literal(int() | float() as number):
                return [float(number)]
            case e.Convert(_, operand, type_) if isinstance(type_, t.Float) or _is_wide(type_):
                return self._of(operand, function, within)
            case e.AddressOf(operand) | e.Unary(Operator.PLUS, operand) | e.Copy(operand):
                return self._of(operand, function, within)
            case e.Unary(Operator.NEGATE, operand):
                return [-n for n in self._of(operand, function, within)]
            case e.Conditional(_, one, other):
                found = [self._of(v, function, within) for v in (one, other)]
                return found[0] + found[1] if all(found) else []
            case e.Binary(operator, left, right):
                parts = (self._of(v, function, within) for v in (left, right))
                return _computed(operator, *parts)
        key = key_of(value, function)
        return [] if key is None or key in within else self._stored(value, key, function, within)

    def _stored(
        self, value: e.Expression, key: Key, function: str, within: frozenset[Key]
    ) -> list[float]:
        """All numbers that are ever stored in a variable, if nothing else is."""
        stored = all_held(self._origins, value, function)
        if any(isinstance(v, AnyValue) for _, v in stored):
            return []
        found = [
            self._of(v, f, within | {key}) if isinstance(v, e.Expression) else [] for f, v in stored
        ]
        numbers = [n for each in found for n in each]
        return numbers if found and all(found) and len(numbers) <= _MOST else []


def _is_wide(type_: t.Type) -> bool:
    return isinstance(type_, t.Integer) and (type_.bits or 64) >= 32


def _computed(operator: Operator, left: list[float], right: list[float]) -> list[float]:
    """What an operator gives of all pairs of numbers."""
    pairs = list(product(left, right))
    if len(pairs) > _MOST:
        return []
    match operator:
        case Operator.ADD:
            return [a + b for a, b in pairs]
        case Operator.SUBTRACT:
            return [a - b for a, b in pairs]
        case Operator.MULTIPLY:
            return [a * b for a, b in pairs]
        case _ if operator in _DIVIDING and all(b for _, b in pairs):
            return [a / b for a, b in pairs]
        case _:
            return []
