"""Types of results in Python, and whether the classes of operands say what an operator does."""

from __future__ import annotations

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir.operators import COMPARISONS, Operator
from rebsync.reverse.ir.types import (
    DOUBLE,
    TRUTH,
    UNBOUNDED,
    UNKNOWN,
    Container,
    Float,
    Integer,
    Type,
    is_plain,
)

OPERATORS = {
    "+": Operator.ADD,
    "-": Operator.SUBTRACT,
    "*": Operator.MULTIPLY,
    "@": Operator.MATRIX_MULTIPLY,
    "/": Operator.TRUE_DIVIDE,
    "//": Operator.FLOOR_DIVIDE,
    "%": Operator.FLOOR_MODULO,
    "**": Operator.POWER,
    "<<": Operator.SHIFT_LEFT,
    ">>": Operator.SHIFT_RIGHT,
    "&": Operator.BIT_AND,
    "|": Operator.BIT_OR,
    "^": Operator.BIT_XOR,
}

_TYPED = (
    *(e.Literal, e.Local, e.Temporary, e.Captured, e.Global, e.Attribute, e.Index, e.Unary),
    *(e.Binary, e.And, e.Or, e.Conditional, e.Convert, e.Build, e.BuildMapping, e.Format),
    *(e.LibraryReference, e.FunctionReference, e.Closure),
)


def type_of(value: e.Expression) -> Type:
    """The type of an expression as far as it says."""
    return value.type if isinstance(value, _TYPED) else UNKNOWN


def result_of(operator: Operator, left: Type, right: Type) -> tuple[Type, bool]:
    """The type of a result, and whether the operands' classes say what it is."""
    if not (is_plain(left) and is_plain(right)):
        return UNKNOWN, True
    if operator in COMPARISONS:
        return TRUTH, False
    number = Integer | Float
    if isinstance(left, Integer) and isinstance(right, Integer):
        if operator is Operator.TRUE_DIVIDE:
            return DOUBLE, False
        return (UNKNOWN if operator is Operator.POWER else UNBOUNDED), False
    if isinstance(left, number) and isinstance(right, number):
        return (UNKNOWN if operator is Operator.POWER else DOUBLE), False
    if left == right and operator is Operator.ADD:
        return left, False
    return UNKNOWN, False


def has_truth(value: e.Expression) -> bool:
    """Whether the class of a value may say whether it counts as true."""
    type_ = type_of(value)
    return not (is_plain(type_) or isinstance(type_, Container))
