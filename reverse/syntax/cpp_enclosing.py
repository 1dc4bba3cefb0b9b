"""What a node of a C++ tree stands in."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_declarations import CppFunction


def enclosing_function(node: Node, functions: Sequence[CppFunction]) -> CppFunction | None:
    """The function that a lambda stands in."""
    bodies = {f.body.id: f for f in functions if f.body is not None}
    return next((bodies[n.id] for n in (node, *ancestors(node)) if n.id in bodies), None)


def enclosing_statement(node: Node) -> Node | None:
    """The statement, or entry of an initialiser list, that a node is in."""
    for at in (node, *ancestors(node)):
        if at.type.endswith("_statement") or at.type in ("declaration", "field_initializer"):
            return at
        if at.type in ("function_definition", "lambda_expression"):
            return None
    return None


def in_lambda(node: Node) -> bool:
    """Whether a node is in a function without a name, which others call."""
    return any(n.type == "lambda_expression" for n in ancestors(node))
