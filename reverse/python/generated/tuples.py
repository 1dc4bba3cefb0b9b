"""Comparisons of tuples and lists that are written out: lexicographical, element by element."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import binary, is_calm
from rebsync.reverse.python.generated import idioms
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.failing import may_fail
from rebsync.reverse.python.generated.kinds import is_floating
from rebsync.reverse.python.generated.py_types import without_parentheses
from rebsync.reverse.syntax.py_tree import named

_SEQUENCES = frozenset({"tuple", "list"})


def compared(reader: ModelExpressionReader, node: Node, operator: str) -> m.Expression | None:
    """`(a, b) < (c, d)`; None for a comparison of something else.

    Unread: the lengths differ, elements are no whole numbers or truth values (for Python an object
    is equal to itself, even one that is no number), or evaluating one may fail or do something: all
    of them are evaluated before any is compared, in the model only those that are asked.
    """
    left, right = map(without_parentheses, named(node))
    if left.type not in _SEQUENCES or left.type != right.type:
        return None
    pairs = list(zip(named(left), named(right), strict=False))
    is_even = len(named(left)) == len(named(right)) > 0
    if not is_even or any(may_fail(reader, each) for pair in pairs for each in pair):
        raise reader.unread(node, "the model has no such comparison")
    read = [(reader.expression(one), reader.expression(other)) for one, other in pairs]
    for sides in read:
        kinds = [reader.kind(side) for side in sides]
        if not all(map(is_calm, sides)):  # a property runs a function
            raise reader.unread(node, "what this does may count for what it is compared with")
        if any(kind is None or is_floating(kind) or kind.dimensions for kind in kinds):
            raise reader.unread(node, "the model has no such comparison")
        idioms.assert_alike(reader, node, operator, sides)
    return idioms.grouped(node, _lexicographical(operator, read))


def _lexicographical(operator: str, pairs: list[tuple[m.Expression, m.Expression]]) -> m.Expression:
    """The first elements that differ decide, and if none do, whether the operator has `=`."""
    word = "||" if operator == "!=" else "&&"
    found = binary(operator, *pairs[-1])
    for left, right in reversed(pairs[:-1]):
        if operator in ("==", "!="):
            found = binary(word, binary(operator, left, right), found)
        else:
            same = binary("&&", binary("==", left, right), found)
            found = binary("||", binary(operator[0], left, right), same)
    return found
