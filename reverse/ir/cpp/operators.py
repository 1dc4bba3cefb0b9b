"""Built-in operators of C++ on values that are there: types, conversions, what they do."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.context import Context, Unlowered, Value
from rebsync.reverse.ir.cpp.conversions import common_type, converted, is_arithmetic, promoted
from rebsync.reverse.ir.cpp.objects import implicitly
from rebsync.reverse.ir.operators import COMPARISONS, Operator
from rebsync.source import Span

ARITHMETIC: Mapping[str, Operator] = {
    **{"+": Operator.ADD, "-": Operator.SUBTRACT, "*": Operator.MULTIPLY},
    **{"/": Operator.TRUE_DIVIDE, "%": Operator.TRUNCATING_REMAINDER},
    **{"<<": Operator.SHIFT_LEFT, ">>": Operator.SHIFT_RIGHT},
    **{"&": Operator.BIT_AND, "|": Operator.BIT_OR, "^": Operator.BIT_XOR},
    **{"bitand": Operator.BIT_AND, "bitor": Operator.BIT_OR, "xor": Operator.BIT_XOR},
}
RELATIONS: Mapping[str, Operator] = {
    **{"==": Operator.EQUAL, "!=": Operator.UNEQUAL, "<": Operator.LESS},
    **{"<=": Operator.LESS_EQUAL, ">": Operator.GREATER, ">=": Operator.GREATER_EQUAL},
    "not_eq": Operator.UNEQUAL,
}
_WHOLE = frozenset({"%", "<<", ">>", "&", "|", "^", "bitand", "bitor", "xor"})
_OF_POINTERS = {Operator.EQUAL: Operator.SAME, Operator.UNEQUAL: Operator.NOT_SAME}
_SHIFTS = frozenset({"<<", ">>"})


def is_built_in(type_: t.Type) -> bool:
    """Whether operators on values of a type are the language's or the standard texts'."""
    return is_arithmetic(type_) or isinstance(
        type_, t.Enumeration | t.Reference | t.Text | t.UnitType
    )


def operation_types(sign: str, left: t.Type, right: t.Type) -> tuple[t.Type, t.Type, t.Type]:
    """What both operands are converted to, and the type of the result."""
    if isinstance(left, t.Text) or isinstance(right, t.Text):
        return _of_texts(sign, left, right)
    if isinstance(left, t.Reference) or isinstance(right, t.Reference):
        return _of_pointers(sign, left, right)
    if sign in _SHIFTS:
        return promoted(left), promoted(right), promoted(left)
    if isinstance(left, t.Enumeration) and left == right and sign in RELATIONS:
        return left, right, t.TRUTH
    common = common_type(left, right)
    if common == t.UNKNOWN or (sign in _WHOLE and isinstance(common, t.Float)):
        raise Unlowered(f"an operation {sign} of these types")
    return common, common, t.TRUTH if sign in RELATIONS else common


def _of_texts(sign: str, left: t.Type, right: t.Type) -> tuple[t.Type, t.Type, t.Type]:
    text = left if isinstance(left, t.Text) else right
    if sign == "+":
        return text, text, text
    if sign in RELATIONS:
        return text, text, t.TRUTH
    raise Unlowered(f"an operation {sign} of a text")


def _of_pointers(sign: str, left: t.Type, right: t.Type) -> tuple[t.Type, t.Type, t.Type]:
    """Comparisons, and arithmetic ([expr.add]): a number is one of elements."""
    pointer = left if isinstance(left, t.Reference) else right
    if sign in RELATIONS:
        return pointer, pointer, t.TRUTH
    if left == right and sign == "-":
        return left, right, t.Integer(64)
    number = right if isinstance(left, t.Reference) else left
    if sign not in ("+", "-") or not isinstance(promoted(number), t.Integer):
        raise Unlowered("arithmetic of pointers")
    wide = t.Integer(64)
    return (left, wide, left) if isinstance(left, t.Reference) else (wide, right, right)


def operator_for(sign: str, operand: t.Type) -> Operator:
    """The operator that a sign is for operands of a type."""
    if sign in RELATIONS:
        found = RELATIONS[sign]
        if isinstance(operand, t.Reference):
            return _OF_POINTERS.get(found, found)
        return found
    if sign == "/" and isinstance(operand, t.Integer):
        return Operator.TRUNCATING_DIVIDE
    if sign not in ARITHMETIC:
        raise Unlowered(f"the operator {sign}")
    return ARITHMETIC[sign]


def binary(sign: str, left: Value, right: Value, place: Span) -> Value:
    """A built-in operation on two values that are read already."""
    # what macros for logs are given goes on what stands before it: a text, or what follows one
    is_stream = sign in _SHIFTS and any(isinstance(x.type, t.Text) for x in (left, right))
    if is_stream or not (is_built_in(left.type) and is_built_in(right.type)):
        return _up_to_library(sign, left, right, place)
    to_left, to_right, result = operation_types(sign, left.type, right.type)
    first = converted(left.expression, left.type, to_left, place)
    second = converted(right.expression, right.type, to_right, place)
    if first is None or second is None:
        raise Unlowered(f"an operation {sign} of these types")
    operator = operator_for(sign, to_left)
    return Value(e.Binary(operator, first, second, result, False, place), result)


def _up_to_library(sign: str, left: Value, right: Value, place: Span) -> Value:
    """What is of a library, or not known, may have operators of its own."""
    operator = RELATIONS.get(sign) or ARITHMETIC[sign]
    types = (left.type, right.type)
    is_value = any(isinstance(x, t.Container | t.Optional | t.Array) for x in types)
    same = left.type == right.type and is_value
    result = t.TRUTH if operator in COMPARISONS and same else t.UNKNOWN
    found = e.Binary(operator, left.expression, right.expression, result, not same, place)
    return Value(found, result, is_lvalue=sign in _SHIFTS)


def unary(context: Context, sign: str, operand: Value, place: Span) -> Value:
    """`-`, `+`, `~` and `!` on a value."""
    if sign in ("!", "not"):
        truth = implicitly(context, operand, t.TRUTH, place)
        is_dynamic = operand.type == t.UNKNOWN
        return Value(e.Unary(Operator.NOT, truth.expression, t.TRUTH, is_dynamic, place), t.TRUTH)
    operators = {"-": Operator.NEGATE, "+": Operator.PLUS, "~": Operator.INVERT}
    operator = operators.get({"compl": "~"}.get(sign, sign))
    if operator is None:
        raise Unlowered(f"an operator {sign}")
    if not is_built_in(operand.type):
        found = e.Unary(operator, operand.expression, t.UNKNOWN, True, place)
        return Value(found, t.UNKNOWN)
    type_ = promoted(operand.type)
    value = converted(operand.expression, operand.type, type_, place)
    if value is None or not is_arithmetic(type_):
        raise Unlowered(f"an operator {sign} of this type")
    if operator is Operator.PLUS:
        return Value(value, type_)
    if operator is Operator.NEGATE and isinstance(value, e.Literal) and _negates(value):
        negative = -value.value  # type: ignore[operator]
        return Value(e.Literal(negative, type_, f"-{value.text}", place), type_)
    return Value(e.Unary(operator, value, type_, False, place), type_)


def _negates(literal: e.Literal) -> bool:
    """Whether the negative of a constant is of its type as well, and no other zero."""
    is_signed = not isinstance(literal.type, t.Integer) or literal.type.signed
    return is_signed and isinstance(literal.value, int | float) and literal.value != 0
