"""Which operands of Python's own types operators take, and which values can be ordered or hashed.

A value of which no type is known fits nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations_with_replacement

from rebsync.reverse.analysis.python.value_types import (
    ContainerType,
    InstanceType,
    LibraryType,
    MessageType,
    OwnType,
    ValueType,
    ValueTypes,
    own_type,
)
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.libraries.attributes import GIVEN_BY, SAME_TIMES

_NUMBER = OwnType.NUMBER
SEQUENCES = frozenset({OwnType.TEXT, OwnType.BYTES, OwnType.LIST, OwnType.TUPLE, OwnType.ARRAY})
_SETS = frozenset({OwnType.SET, OwnType.FROZEN})
SIZED = SEQUENCES | _SETS | {OwnType.MAPPING, OwnType.QUEUE}
# Functions that go through what they get first.
OF_ELEMENTS = frozenset(
    f"builtins.{n}"
    for n in (
        *("len", "sum", "any", "all", "sorted", "list", "tuple", "set", "enumerate"),
        *("iter", "zip"),
    )
)
ITERABLE = SIZED | {OwnType.MODEL_ARRAY}
INDEXED = SEQUENCES | {OwnType.QUEUE, OwnType.MAPPING, OwnType.MODEL_ARRAY}
UNHASHABLE = frozenset(
    {OwnType.LIST, OwnType.SET, OwnType.MAPPING, OwnType.QUEUE, OwnType.MODEL_ARRAY}
)
_ADDED = SEQUENCES | {OwnType.QUEUE}
ORDERED = (Operator.LESS, Operator.LESS_EQUAL, Operator.GREATER, Operator.GREATER_EQUAL)
_WITHOUT_ORDER = frozenset({OwnType.MAPPING, OwnType.NONE, OwnType.MESSAGE, OwnType.MODEL_ARRAY})
_OF_SETS = (Operator.BIT_AND, Operator.BIT_OR, Operator.BIT_XOR, Operator.SUBTRACT)


def takes(operator: Operator, left: OwnType | None, right: OwnType | None) -> bool:
    """Whether an operator takes operands of two types, as far as they are known."""
    if left is None or right is None:
        return False
    match operator:
        case _ if left is right is _NUMBER:
            return True
        case Operator.ADD:
            is_array = OwnType.ARRAY in (left, right)
            return {left, right} <= _ADDED and (left is right or is_array)
        case Operator.MULTIPLY:
            return {left, right} in [{_NUMBER, each} for each in _ADDED]
        case Operator.FLOOR_MODULO:
            return left is OwnType.TEXT
        case _ if operator in ORDERED:
            return (left is right and left not in _WITHOUT_ORDER) or {left, right} <= _SETS
        case _ if operator in _OF_SETS:
            is_mapping = left is right is OwnType.MAPPING and operator is Operator.BIT_OR
            return {left, right} <= _SETS or is_mapping
        case _:
            return False


def given_by(operator: Operator, left: ValueType | None, right: ValueType | None) -> str:
    """The class of what an operator gives for a time or a path; empty if none."""
    symbol = "<" if operator in ORDERED else operator.value
    return GIVEN_BY.get((symbol, _name(left), _name(right)), "")


def _name(type_: ValueType | None) -> str:
    if isinstance(type_, LibraryType):
        return SAME_TIMES.get(type_.name, type_.name)
    own = own_type(type_)
    return own.value if own is not None else ""


def are_ordered(types: ValueTypes, has_order: Callable[[str], bool]) -> bool:
    """Whether each value of some types can be compared with each; `has_order` asks of a class."""
    pairs = combinations_with_replacement(sorted(types, key=str), 2)
    return all(_is_ordered(one, other, has_order) for one, other in pairs)


def are_comparable(left: ValueTypes, right: ValueTypes, has_order: Callable[[str], bool]) -> bool:
    """Whether each value of some types can be compared with each of others."""
    return all(_is_ordered(one, other, has_order) for one in left for other in right)


def _is_ordered(
    one: ValueType | None, other: ValueType | None, has_order: Callable[[str], bool]
) -> bool:
    match one, other:
        case (None, _) | (_, None):
            return False
        case (LibraryType(), _) | (_, LibraryType()):
            return bool(given_by(Operator.LESS, one, other))
        case InstanceType(name), _:
            return has_order(name)
        case _, InstanceType(name):
            return has_order(name)
        case ContainerType(OwnType.TUPLE, parts=first), ContainerType(OwnType.TUPLE, parts=second):
            return first is None or second is None or _are_parts(first, second, has_order)
        case ContainerType(OwnType.LIST, first_ones), ContainerType(OwnType.LIST, others):
            return are_ordered(first_ones | others, has_order)
        case _:
            return takes(Operator.LESS, own_type(one), own_type(other))


def _are_parts(
    one: tuple[ValueTypes, ...], other: tuple[ValueTypes, ...], has_order: Callable[[str], bool]
) -> bool:
    """Whether tuples can be compared: each part may be where two of them differ."""
    return all(
        are_ordered(first | second, has_order) for first, second in zip(one, other, strict=False)
    )


def is_hashable(types: ValueTypes, has_hash: Callable[[str], bool]) -> bool:
    """Whether values of some types can be keys, or elements of sets; `has_hash` asks of a class."""
    return all(_is_hashable(type_, has_hash) for type_ in types)


def _is_hashable(type_: ValueType | None, has_hash: Callable[[str], bool]) -> bool:
    match type_:
        case ContainerType(OwnType.TUPLE, elements):
            return is_hashable(elements, has_hash)
        case InstanceType(name):
            return has_hash(name)
        case None:
            return False
        case MessageType():
            return True  # some have one
        case _:
            return own_type(type_) not in UNHASHABLE
