"""Statements of generated bodies that no model describes: what is logged, and users' own blocks.

They may look at what the model has, and do what they like with the rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_effects import Effects
from rebsync.reverse.bodies.cpp_plain_locals import declared_names
from rebsync.reverse.bodies.known_functions import CONSOLE, LOGGING
from rebsync.reverse.syntax.cpp_tree import part, text_of

if TYPE_CHECKING:
    from rebsync.reverse.bodies.cpp_statements import CppStatements


def block_after(
    reader: CppStatements, markers: Sequence[str], before: Effects | None
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


def check_names(reader: CppStatements, node: Node) -> None:
    """Raises `Unread` where a declaration in a user's block hides what the model has."""
    if node.type == "declaration":
        for name in declared_names(node):
            if reader.scope.meaning(name.lstrip("&* ")) is not None:
                raise reader.unread(node, f'this hides "{name}" from what follows')


def is_log(reader: CppStatements, statement: Node, node: Node) -> bool:
    """Whether the expression of a statement logs, or says of a variable that nothing uses it.

    Raises `Unread` where that does more to the model than to look at it.
    """
    if node.type != "call_expression":
        return False
    function = part(node, "function")
    if text_of(function) == "unused":
        return True
    logs = function.type == "identifier" and text_of(function).startswith(LOGGING)
    if not logs and (reader.scope.open or text_of(function) not in CONSOLE):
        return False
    if reader.scope.open:  # then it is not outside
        raise reader.unread(statement, "what is logged here changes what the model has")
    Effects(reader.cpp, reader.scope).check(node)
    return True
