"""Statements of generated bodies that no model describes: what is logged, and users' own blocks.

They may look at what the model has, and do what they like with the rest.
"""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_plain_locals import declared_names
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_effects import Effects
from rebsync.reverse.bodies.effects.known_functions import UNUSED, logs
from rebsync.reverse.bodies.scope import Ignored
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.syntax.cpp_tree import named, part, text_of


def block_after(
    reader: CppStatementReader, markers: Sequence[str], before: Effects | None
) -> Effects | None:
    """The user's block in which the statement behind some markers stands; None outside of one.

    `before` is that of the statement before. Between `rebsync: user NAME` and `rebsync: end`
    effects are all that counts.
    """
    for text in markers:
        if text.startswith("user "):
            before = Effects(reader.cpp, reader.scope)
        elif text.split()[:1] == ["end"]:
            before = None
    return before


def check_names(reader: CppStatementReader, node: Node) -> None:
    """Raises `Unread` where a declaration in a user's block hides what the model has."""
    if node.type == "declaration":
        for name in declared_names(node):
            if reader.scope.meaning(name.lstrip("&* ")) is not None:
                raise reader.unread(node, f'this hides "{name}" from what follows')


def is_logging(node: Node) -> bool:
    """Whether a statement does nothing but to log, by how it is written."""
    match node.type:
        case "if_statement":
            ways = [part(node, "consequence")]
            if (other := node.child_by_field_name("alternative")) is not None:
                ways += named(other)
            return all(map(is_logging, ways))
        case "compound_statement":
            return bool(named(node)) and all(map(is_logging, named(node)))
        case "expression_statement" if named(node):
            return logs(named(node)[0])
        case _:
            return False


def tells(reader: CppStatementReader, node: Node) -> bool:
    """Whether a statement logs, or calls a function of a generated class that only does."""
    inner = named(node)[0] if node.type == "expression_statement" and named(node) else node
    name = text_of(part(inner, "function")) if inner.type == "call_expression" else ""
    if reader.scope.open:
        return name.startswith(libraries.logging())
    return isinstance(reader.scope.functions.get(name), Ignored) or is_logging(node)


def is_unused(reader: CppStatementReader, statement: Node, node: Node) -> bool:
    """Whether the expression of a statement says of variables that nothing uses them.

    Raises `Unread` where that does more to the model than to look at it.
    """
    if node.type != "call_expression" or text_of(part(node, "function")) != UNUSED:
        return False
    given = [a for a in named(part(node, "arguments")) if a.type != "identifier"]
    if not all(is_calm(reader.expressions.read(a)) for a in given):
        raise reader.unread(statement, "this does something, whatever becomes of its value")
    return True
