"""Calls of methods that give several values at once: what each gives stands in its place."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.py_types import call_parts
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.py_tree import decorators_of, text_of


def values_in_place(reader: ModelExpressionReader, node: Node) -> list[Node]:
    """The values that a call of such a method, or a property, stands for; empty for others."""
    called, arguments = call_parts(node) or ("", [])
    holder, _, name = (called or text_of(node)).rpartition(".")
    is_own = holder == reader.own == "self" and not arguments
    given = reader.names.pairs.get(name, ()) if is_own else ()
    return [*given] if given and _is_property(given[0]) == (not called) else []


def _is_property(value: Node) -> bool:
    """Whether the method that gives a value is read as an attribute is."""
    method = climb(value, lambda node: node.type == "function_definition")
    return method is not None and len(decorators_of(method)) > 0
