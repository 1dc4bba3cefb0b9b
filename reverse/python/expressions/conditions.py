"""Conditions of Python: `and` and `or`, chains of comparisons, and what is in a container."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import binary, number_literal
from rebsync.reverse.python.expressions.elements import certain, known_range
from rebsync.reverse.python.expressions.operands import OperandReader
from rebsync.reverse.python.expressions.values import REAL, STRING, TRUTH, WHOLE, Value
from rebsync.reverse.syntax.py_tree import field, is_asked, named, text_of

_SIGNS = frozenset({"<", ">", "<=", ">=", "==", "!=", "<>"})
_RANGES = ("builtins.range", "builtins.xrange")


def connected(reader: OperandReader, node: Node) -> Value:
    """`a and b`, `a or b`: a truth where only that is asked for, else one of the two values."""
    word = "&&" if text_of(field(node, "operator")) == "and" else "||"
    left, right = field(node, "left"), field(node, "right")
    if is_asked(node, reader.asking):
        sides = reader.condition(left), reader.condition(right)
        return Value(binary(word, *sides, reader.span(node)), TRUTH)
    one, other = reader.read(left), reader.read(right)
    kinds = {one.kind, other.kind}
    if not kinds & {WHOLE, REAL, STRING}:
        sides = reader.truth(one, left), reader.truth(other, right)
        return Value(binary(word, *sides, reader.span(node)), TRUTH)
    if not reader.is_calm(one) or (len(kinds) > 1 and not reader.mixes):
        raise reader.unread(node, "this is one of two values, which are to be in variables")
    ways = (other, one) if word == "&&" else (one, other)
    return reader.joined(reader.truth(one, left), *ways, node)


def signs_of(node: Node) -> list[str]:
    """The operators of a comparison, in their order."""
    return [" ".join(text_of(c).split()) for c in node.children_by_field_name("operators")]


def comparison(reader: OperandReader, node: Node) -> m.Expression:
    """`a <= b < c`, `a in (1, 2)` and `a not in (1, 2)`. Unread: the model has no such thing."""
    operands, signs = named(node), signs_of(node)
    if signs in (["in"], ["not in"]):
        return _is_in(reader, node, signs == ["in"])
    if len(signs) != len(operands) - 1 or not set(signs) <= _SIGNS:
        raise reader.unread(node, "the model has no such comparison")
    values = [reader.read(operand) for operand in operands]
    if not reader.is_calm(*values[1:-1]):
        raise reader.unread(node, "what stands in the middle would run twice")
    pairs = zip(signs, values, values[1:], strict=False)
    return _all(reader, node, "&&", [(sign, one, other) for sign, one, other in pairs])


def _is_in(reader: OperandReader, node: Node, holds: bool) -> m.Expression:
    one, listed = named(node)
    value = reader.read(one)
    called = reader.library(field(listed, "function")) if listed.type == "call" else ""
    found = known_range(named(field(listed, "arguments"))) if called in _RANGES else None
    if found is not None and found.step == 1:
        if value.kind != WHOLE:
            raise reader.unread(node, "only whole numbers are in a range")
        ends = [Value(number_literal(end), WHOLE) for end in (found.start, found.stop)]
        signs, word = ((">=", "<"), "&&") if holds else (("<", ">="), "||")
        pairs = [(sign, value, end) for sign, end in zip(signs, ends, strict=True)]
    else:
        sign, word = ("==", "||") if holds else ("!=", "&&")
        pairs = [(sign, value, other) for other in certain(reader, listed, "in")]
    if not pairs or (len(pairs) > 1 and not reader.is_calm(value)):
        raise reader.unread(node, "what this compares more than once is to be in a variable first")
    return _all(reader, node, word, pairs)


def _all(
    reader: OperandReader, node: Node, word: str, pairs: list[tuple[str, Value, Value]]
) -> m.Expression:
    """Comparisons that are joined by `&&` or `||`."""
    found: m.Expression | None = None
    for number, (sign, left, right) in enumerate(pairs):
        one = reader.compared(sign, left, right, node, number)
        found = one if found is None else binary(word, found, one, reader.span(node))
    assert found is not None
    return found
