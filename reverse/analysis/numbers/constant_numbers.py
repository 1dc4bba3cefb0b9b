"""Whole numbers that constants are computed from others: constant folding."""

from __future__ import annotations

from rebsync.records import dataclass
from rebsync.reverse.analysis.held_values import held_by
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator

_DEEPEST = 8
# Constants of C's library ([c.math]), which are floating.
_FLOATING = "M_"
_ARITHMETIC = frozenset(
    {Operator.ADD, Operator.SUBTRACT, Operator.MULTIPLY}
    | {Operator.TRUE_DIVIDE, Operator.CLASSIC_DIVIDE, Operator.TRUNCATING_DIVIDE}
)


@dataclass(frozen=True, slots=True)
class ConstantNumbers:
    """The constants of one function, and of what is around it."""

    origins: Origins
    function: str

    def of(self, value: object, depth: int = 0) -> int | None:
        """The number that an expression always is; None where that is not known."""
        match value:
            case e.Literal(int() as number):
                return int(number)
            case e.Convert(_, operand, t.Integer()):
                return self.of(operand, depth)
            case e.Binary(operator, left, right):
                return _computed(operator, self.of(left, depth), self.of(right, depth))
            case e.Global() | e.Attribute() | e.Local() if depth < _DEEPEST:
                stored = held_by(self.origins, value, self.function)
                return self.of(stored[0][1], depth + 1) if len(stored) == 1 else None
            case _:
                return None


def _computed(operator: Operator, left: int | None, right: int | None) -> int | None:
    """What an operator gives of whole numbers that are not negative."""
    if left is None or right is None or left < 0 or right < 0:
        return None
    match operator:
        case Operator.ADD:
            return left + right
        case Operator.MULTIPLY:
            return left * right
        case Operator.TRUNCATING_DIVIDE | Operator.FLOOR_DIVIDE if right:
            return left // right
        case _:
            return None


def is_floating(value: e.Expression) -> bool:
    """Whether a value of C++ is surely a floating number, by a part that is one."""
    match value:
        case e.LibraryReference(name) | e.Attribute(_, name) if name.startswith(_FLOATING):
            return True  # a macro, also where a class that was not read may have members
        case e.Convert(_, _, t.Integer()):
            return False
        case e.Binary(operator, left, right) if operator in _ARITHMETIC:
            return is_floating(left) or is_floating(right)
        case e.Unary(_, operand):
            return is_floating(operand)
        case _:
            return isinstance(getattr(value, "type", None), t.Float)
