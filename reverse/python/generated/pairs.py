"""Calls of methods that give several values at once: what each gives stands in its place."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.py_types import call_parts


def values_in_place(reader: ModelExpressionReader, node: Node) -> list[Node]:
    """The values that a call of such a method stands for; empty for any other expression."""
    called, arguments = call_parts(node) or ("", [])
    holder, _, name = called.rpartition(".")
    pairs = reader.names.pairs
    return [*pairs.get(name, ())] if holder == reader.own == "self" and not arguments else []
