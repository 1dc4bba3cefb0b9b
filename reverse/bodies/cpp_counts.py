"""Counts within values that the model has no place for: `msg.data = "no. " + to_string(n++)`."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_effects import Effects
from rebsync.reverse.bodies.effects.cpp_kinds import SHORT_CIRCUIT
from rebsync.reverse.bodies.effects.cpp_roots import is_modelled, root
from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

# What is in these may be evaluated later, or not at all.
_PERHAPS = frozenset({"lambda_expression", "conditional_expression"})


def counted(reader: CppStatementReader, node: Node) -> list[m.Statement] | None:
    """The counts of a statement that does nothing else to the model; None for other statements."""
    inner = named(node)
    if node.type != "expression_statement" or len(inner) != 1:
        return None
    if inner[0].type != "assignment_expression" or text_of(part(inner[0], "operator")) != "=":
        return None
    counts = list(_counts(part(inner[0], "right")))
    names = [root(reader.scope, set(), part(c, "argument"))[0] for c in counts]
    left = part(inner[0], "left")
    if len(set(names)) < len(counts) or is_modelled(left, root(reader.scope, set(), left)[1]):
        return None
    effects = Effects(reader.cpp, reader.scope, frozenset(reader.own), everything=True)
    try:
        effects.check(node)
        if not counts or effects.written - set(names):
            return None
        return [s for c in counts for s in reader.done(c, reader.effect(c))]
    except Unread:
        return None


def _counts(node: Node) -> Iterator[Node]:
    """What counts in an expression whenever it is evaluated, in the order of the text."""
    if node.type == "update_expression":
        yield node
    elif node.type not in _PERHAPS and not _may_stop(node):
        for child in node.named_children:
            yield from _counts(child)


def _may_stop(node: Node) -> bool:
    """Whether the second operand is evaluated only where the first one leaves it open."""
    if node.type != "binary_expression":
        return False
    return text_of(part(node, "operator")) in SHORT_CIRCUIT
