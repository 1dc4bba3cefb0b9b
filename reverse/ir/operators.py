"""Operators of the intermediate form, and what languages call without a call in the text."""

from __future__ import annotations

from enum import Enum


class Operator(Enum):
    """An operator by what it does: division of two languages is two operators."""

    ADD = "+"
    SUBTRACT = "-"
    MULTIPLY = "*"
    MATRIX_MULTIPLY = "@"
    TRUE_DIVIDE = "/"  # the quotient as a float
    CLASSIC_DIVIDE = "div"  # of two whole numbers the floor, else the quotient as a float
    FLOOR_DIVIDE = "div_floor"
    TRUNCATING_DIVIDE = "div_trunc"
    FLOOR_MODULO = "mod_floor"  # has the sign of the divisor
    TRUNCATING_REMAINDER = "rem_trunc"  # has the sign of the dividend
    POWER = "**"
    SHIFT_LEFT = "<<"
    SHIFT_RIGHT = ">>"
    BIT_AND = "&"
    BIT_OR = "|"
    BIT_XOR = "^"
    EQUAL = "=="
    UNEQUAL = "!="
    LESS = "<"
    LESS_EQUAL = "<="
    GREATER = ">"
    GREATER_EQUAL = ">="
    SAME = "is"  # one and the same object
    NOT_SAME = "is not"
    IN = "in"
    NOT_IN = "not in"
    NEGATE = "neg"
    PLUS = "pos"
    INVERT = "~"
    NOT = "not"


COMPARISONS = frozenset(
    {
        *(Operator.EQUAL, Operator.UNEQUAL, Operator.LESS, Operator.LESS_EQUAL),
        *(Operator.GREATER, Operator.GREATER_EQUAL, Operator.SAME, Operator.NOT_SAME),
        *(Operator.IN, Operator.NOT_IN),
    }
)


# What a comparison is with its operands exchanged.
MIRRORED = {
    Operator.LESS: Operator.GREATER,
    Operator.GREATER: Operator.LESS,
    Operator.LESS_EQUAL: Operator.GREATER_EQUAL,
    Operator.GREATER_EQUAL: Operator.LESS_EQUAL,
}


class ImplicitCall(Enum):
    """What runs a method of a class though no call stands in the text."""

    GET_ATTRIBUTE = "get attribute"
    SET_ATTRIBUTE = "set attribute"
    DELETE_ATTRIBUTE = "delete attribute"
    GET_ITEM = "get item"
    SET_ITEM = "set item"
    DELETE_ITEM = "delete item"
    CALL = "call"
    ITERATE = "iterate"
    NEXT = "next"
    LENGTH = "length"
    TRUTH = "truth"
    NUMBER = "number"
    TEXT = "text"
    HASH = "hash"
    ENTER = "enter"
    EXIT = "exit"
    CONSTRUCT = "construct"
    DESTROY = "destroy"
    COPY = "copy"
    MOVE = "move"
    DESCRIBE = "describe"  # an attribute that answers for itself (descriptor)
    DERIVE = "derive"  # a subclass is declared
    AWAIT = "await"


class Conversion(Enum):
    """How a value becomes one of another type."""

    TRUNCATE = "truncate"  # a float to the whole number towards zero
    WRAP = "wrap"  # a whole number modulo two to the bits of the type
    NARROW = "narrow"  # a float to one of fewer bits
    WIDEN = "widen"  # nothing is lost
    TRUTH = "truth"
    TEXT = "text"
    CAST = "cast"  # the same bits or object by another type
