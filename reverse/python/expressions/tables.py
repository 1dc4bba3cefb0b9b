"""Tables that code only looks into: `TABLE[key]` and `TABLE.get(key, otherwise)`."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.models.building import whole_number
from rebsync.reverse.python.expressions.elements import MOST
from rebsync.reverse.python.expressions.operands import OperandReader
from rebsync.reverse.python.expressions.values import STRING, WHOLE, Value
from rebsync.reverse.syntax.py_tree import field, named, text_of


def looked_up(reader: OperandReader, call: Node) -> Value | None:
    """`TABLE.get(key, otherwise)`; None for another call."""
    function, arguments = field(call, "function"), named(field(call, "arguments"))
    is_get = function.type == "attribute" and text_of(field(function, "attribute")) == "get"
    if not is_get or len(arguments) != 2 or any(a.type in _OTHERS for a in arguments):
        return None
    pairs, otherwise = pairs_of(reader, field(function, "object")), arguments[1]
    if not pairs or reader.may_fail(otherwise):
        return None
    asked, other = map(reader.read, arguments)
    return selected(reader, call, asked, pairs, other) if reader.is_calm(other) else None


_OTHERS = ("keyword_argument", "list_splat", "dictionary_splat")


def pairs_of(reader: OperandReader, node: Node) -> Sequence[tuple[Value, Value]] | None:
    """The keys and values of a table, no key twice; None where nobody knows these."""
    if node.type != "dictionary":
        return reader.table(node)
    parts = [part for part in named(node) if part.type == "pair"]
    if len(parts) != len(named(node)) or not 0 < len(parts) <= MOST:
        return None
    found: dict[m.Expression, tuple[Value, Value]] = {}
    for part in parts:
        key, value = reader.read(field(part, "key")), reader.read(field(part, "value"))
        known = key.expression
        is_known = whole_number(known) is not None or isinstance(known, m.StringLiteral)
        if not is_known or not reader.is_calm(value) or reader.may_fail(field(part, "value")):
            return None
        found[known] = key, value  # of two values of one key the last counts
    return list(found.values())


def selected(
    reader: OperandReader,
    node: Node,
    asked: Value,
    pairs: Sequence[tuple[Value, Value]],
    otherwise: Value,
) -> Value:
    """The value of a key in a table, or another one if the table has no such key."""
    if asked.kind not in (WHOLE, STRING) or not reader.is_calm(asked):
        raise reader.unread(node, "what this looks for is to be a whole number in a variable")
    found = otherwise
    for number, (known, value) in reversed(list(enumerate(pairs))):
        is_it = reader.compared("==", asked, known, node, number)
        found = reader.joined(is_it, value, found, node)
    return found
