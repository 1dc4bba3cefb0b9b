"""Comparisons of tuples and lists that are written out: lexicographical, element by element."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial, reduce

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import binary, is_calm
from rebsync.reverse.python.generated import idioms
from rebsync.reverse.python.generated.arrays import array_elements
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.failing import may_fail
from rebsync.reverse.python.generated.kinds import is_floating
from rebsync.reverse.python.generated.py_types import call_parts, without_parentheses
from rebsync.reverse.syntax.py_tree import field, named, text_of


def kept(reader: ModelExpressionReader, node: Node) -> list[m.Expression] | None:
    """The elements of a local that is a tuple (`records.behind`); None for anything else."""
    found = list[m.Expression]()
    while (each := reader.bound.get(f"{text_of(node)}.{len(found)}")) is not None:
        found.append(each)
    return found or None


def _elements(
    reader: ModelExpressionReader, node: Node
) -> tuple[str, Sequence[Node | m.Expression]] | None:
    """What is in a tuple or list that is written out, kept, or made of an array; else None."""
    node = without_parentheses(node)
    if node.type in ("tuple", "list"):
        return node.type, named(node)
    called, arguments = call_parts(node) or ("", [])
    if called == "tuple" and reader.library(field(node, "function")) and len(arguments) == 1:
        found = array_elements(reader, arguments[0])
    else:
        found = kept(reader, node)
    return None if found is None else ("tuple", found)


def is_among(reader: ModelExpressionReader, node: Node, signs: list[str]) -> m.Expression | None:
    """`(a, b) in (here, there)`; None where what is looked for is no tuple."""
    if signs not in (["in"], ["not in"]):
        return None
    left, right = map(without_parentheses, named(node))
    if _elements(reader, left) is None or right.type not in ("tuple", "list"):
        return None
    sign, word = ("==", "||") if signs == ["in"] else ("!=", "&&")
    each = [compared(reader, node, sign, (left, other)) for other in named(right)]
    found = [one for one in each if one is not None]
    if not found or len(found) < len(each):
        raise reader.unread(node, "the model has no such comparison")
    return idioms.grouped(node, reduce(partial(binary, word), found))


def compared(
    reader: ModelExpressionReader, node: Node, operator: str, sides: Sequence[Node]
) -> m.Expression | None:
    """`(a, b) < (c, d)`; None for a comparison of something else.

    Unread: the lengths differ, elements are no whole numbers or truth values (for Python an object
    is equal to itself, even one that is no number), or evaluating one may fail or do something: all
    of them are evaluated before any is compared, in the model only those that are asked.
    """
    left, right = (_elements(reader, side) for side in sides)
    if left is None or right is None or left[0] != right[0]:
        return None
    pairs = list(zip(left[1], right[1], strict=False))
    parts = [each for both in pairs for each in both]
    is_even = len(left[1]) == len(right[1]) > 0
    if not is_even or any(isinstance(each, Node) and may_fail(reader, each) for each in parts):
        raise reader.unread(node, "the model has no such comparison")
    read = [(_read(reader, one), _read(reader, other)) for one, other in pairs]
    for pair in read:
        kinds = [reader.kind(side) for side in pair]
        if not all(map(is_calm, pair)):  # a property runs a function
            raise reader.unread(node, "what this does may count for what it is compared with")
        if any(kind is None or is_floating(kind) or kind.dimensions for kind in kinds):
            raise reader.unread(node, "the model has no such comparison")
        idioms.assert_alike(reader, node, operator, pair)
    return idioms.grouped(node, _lexicographical(operator, read))


def _read(reader: ModelExpressionReader, element: Node | m.Expression) -> m.Expression:
    return reader.expression(element) if isinstance(element, Node) else element


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
