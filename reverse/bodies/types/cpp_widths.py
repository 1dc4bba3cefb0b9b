"""Integers of C++ that hold more than the model's `int`: where that makes a difference.

The model has the lower 32 bits of each. Sums, products and what else only depends on these come
out right whatever wraps. What looks at the whole number is read where that is known to be one that
an `int` holds: comparisons, quotients, shifts to the right, conversions to floating numbers.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.intervals import Interval, exactly, of_bits
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.cpp_misread import ChainOperand
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.bodies.types.cpp_ranges import (
    COMPARES,
    INT_BITS,
    LOGICAL,
    NAMES_WIDE,
    Ranged,
    as_type,
    range_of,
)
from rebsync.reverse.bodies.types.cpp_types import Carried
from rebsync.reverse.models.building import bare, binary, is_calm
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_tree import inside, named, operator_of, part, text_of
from rebsync.static.constants import constant
from rebsync.static.types import is_floating

_MAY_BE_WIDE = re.compile(
    r"size\(\)|sizeof|size_t|\blong\b|unsigned|uint|int64|\b(?:0x[\da-f]+|\d+)[ul]", re.IGNORECASE
)
_WORD = re.compile(r"[A-Za-z_]\w*")
_PLACES = frozenset(
    {"identifier", "qualified_identifier", "field_expression", "subscript_expression"}
)
_ORDERS = frozenset({"<", ">", "<=", ">="})
_ZERO = m.IntLiteral(0)
_OBSERVES = COMPARES | {"/", "%", ">>", "<<"}


def place_of(name: str, kept: Carried) -> Variable:
    """A variable of a type."""
    return Variable(name, kept.type, kept.bits, (), kept.wide)


def wide_of(reader: CppExpressionReader, node: Node) -> int:
    """The `wide` of a variable that `auto` makes for a value."""
    found = range_of(reader.cpp, reader.scope, node)
    return found.bits if found is not None and found.bits > INT_BITS else 0


def is_wide(reader: CppExpressionReader, operand: ChainOperand) -> bool:
    """Whether an operand is of a type that is wider than an int, or has no sign."""
    found = range_of(operand.cpp, reader.scope, operand.node) if reader.scope.open else None
    return found is not None and found.bits > INT_BITS


# --- what looks at whole numbers ----------------------------------------------------------------


def exact(reader: CppExpressionReader, operator: str, sides: Sequence[Node]) -> str:
    """`!=` for `>` where a number of 32 bits without a sign is compared with 0."""
    if operator != ">" or not _is_asked(reader, *sides):
        return operator
    left, right = (range_of(reader.cpp, reader.scope, side) for side in sides)
    if left is None or right is None or left.bits != 32 or left.fits:
        return operator
    return "!=" if right.values == exactly(0) and right.bits <= 32 else operator


def ordered(
    reader: CppExpressionReader,
    operator: str,
    sides: Sequence[Node],
    values: tuple[m.Expression, m.Expression],
) -> m.Expression | None:
    """`<` and its like where the wider type has no sign, by the signs of the model's numbers.

    `>= 0` holds of all of them.

    None where these compare alike, and where one of 64 bits may be more than an `int` can be.
    """
    if operator not in _ORDERS or not reader.scope.open:
        return None
    left, right = (range_of(reader.cpp, reader.scope, side) for side in sides)
    if left is None or right is None or max(left.bits, right.bits) not in (32, 64):
        return None
    bits = max(left.bits, right.bits)
    is_zero = right.values == exactly(0) and isinstance(bare(values[0]), m.Name | m.Member)
    if is_zero and operator in ("<", ">="):  # no number without a sign is below it
        return m.BoolLiteral(operator == ">=")
    if any(bits == 64 and not side.fits for side in (left, right)):
        return None
    signs = [side.values.low < 0 or not side.fits for side in (left, right)]
    if not any(signs) or not all(is_calm(value) for value in values):
        return None
    one, other = values
    plain = binary(operator, one, other)
    if operator in (">", ">="):
        one, other, signs = other, one, signs[::-1]
    if not signs[0]:  # the greater one may be too large for the sign
        return binary("||", plain, binary("<", other, _ZERO))
    if not signs[1]:
        return binary("&&", plain, binary(">=", one, _ZERO))
    low, high = binary("<", one, _ZERO), binary("<", other, _ZERO)
    return m.Conditional(binary("==", low, high), plain, high)


def check(reader: CppExpressionReader, node: Node, operator: str, sides: Sequence[Node]) -> None:
    """Raises where an operator looks at a number that an `int` need not hold."""
    if not _is_asked(reader, node):
        return
    left, right = (range_of(reader.cpp, reader.scope, side) for side in sides)
    if left is None or right is None:
        for side, found in zip(sides, (left, right), strict=True):
            if found is not None and operator not in LOGICAL and not found.fits:
                _raise(reader, side)
        return
    if operator not in _OBSERVES:
        for side, found in zip(sides, (left, right), strict=True):
            if _wraps_first(side, found, max(left.bits, right.bits)):
                _raise(reader, side)
        return
    if operator in ("<<", ">>"):
        looks = operator == ">>" and not left.fits
        known = Interval(0, 31).includes(right.values)
        if (looks or not known) and max(left.bits, right.bits) > INT_BITS:
            _raise(reader, node)
        return
    bits, equals = max(left.bits, right.bits), operator in ("==", "!=")
    if bits == INT_BITS or (equals and (bits == 32 or (left.fits and right.fits))):
        return
    for side, found in zip(sides, (left, right), strict=True):
        if not as_type(found, bits).fits:
            _raise(reader, side)


def is_only_compared(declarator: Node, name: str) -> bool:
    """Whether nothing but comparisons, which are read exactly or not at all, look at a local."""
    block = climb(declarator, lambda n: n.type == "compound_statement")
    names = inside(block, "identifier") if block is not None else []
    uses = [n.parent for n in names if text_of(n) == name and n.parent != declarator]
    is_compare = (n is not None and operator_of(n) in COMPARES for n in uses)
    return bool(names) and all(is_compare)


def check_whole(reader: CppExpressionReader, node: Node) -> None:
    """Raises where an integer is none that an `int` is sure to hold."""
    found = range_of(reader.cpp, reader.scope, node) if _is_asked(reader, node) else None
    if found is not None and not found.fits:
        _raise(reader, node)


def check_truth(reader: CppExpressionReader, node: Node) -> None:
    """Raises where a number of more than 32 bits need not be an `int`, and so may be another 0."""
    found = range_of(reader.cpp, reader.scope, node) if _is_asked(reader, node) else None
    if found is not None and found.bits > 32 and not found.fits:
        _raise(reader, node)


def check_stored(
    reader: CppExpressionReader, node: Node, value: m.Expression, place: Variable
) -> None:
    """Raises where a floating variable gets an integer that an `int` need not hold, one of these
    a floating number, or one of 64 bits what may have wrapped at 32.
    """
    if place.type is not None and is_floating(place.type):
        check_whole(reader, node)
    elif place.wide and reader.scope.open and constant(value) is None:
        of = type_in(reader.scope, value)
        found = range_of(reader.cpp, reader.scope, node)
        floats = of is not None and is_floating(of)
        if floats or (found is not None and _wraps_first(node, found, place.wide)):
            _raise(reader, node)


def check_wide_call(reader: CppExpressionReader, node: Node) -> None:
    """Raises where `std::max<unsigned>(a, b)` may make other numbers of what it compares."""
    name, arguments = text_of(part(node, "function")), named(part(node, "arguments"))
    if not reader.scope.open or not NAMES_WIDE.search(name.partition("<")[2]):
        return
    for argument in arguments:
        found = range_of(reader.cpp, reader.scope, argument)
        if found is None or found.values.low < 0 or _wraps_first(argument, found, 64):
            _raise(reader, argument)


def _wraps_first(node: Node, found: Ranged, bits: int) -> bool:
    """Whether a number may have wrapped at 32 bits before it becomes one of so many bits.

    The model's wraps where it is stored: that is another one. Variables have what was stored.
    """
    while node.type == "parenthesized_expression" and len(named(node)) == 1:
        node = named(node)[0]
    whole = found.bits == 32 < bits and found.values == of_bits(32)
    return whole and node.type not in _PLACES


def _is_asked(reader: CppExpressionReader, *nodes: Node) -> bool:
    """Whether there may be such numbers: generated code has none, unless people wrote them.

    A constant by its name may be of any type.
    """
    scope = reader.scope
    if scope.open or any(_MAY_BE_WIDE.search(text_of(n)) for n in nodes):
        return True
    words = {word for n in nodes for word in _WORD.findall(text_of(n))}
    return not (words.isdisjoint(scope.constants) and words.isdisjoint(scope.enumerators))


def _raise(reader: CppExpressionReader, node: Node) -> None:
    why = f'"{" ".join(text_of(node).split())}" may wrap, or be more than the model\'s int can be'
    raise reader.unknown(node, why)
