"""What a node of a C++ tree stands in."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.syntax.cpp_declarations import CppFunction


def enclosing_function(node: Node, functions: Sequence[CppFunction]) -> CppFunction | None:
    """The function that a lambda stands in."""
    at: Node | None = node
    while at is not None:
        for function in functions:
            if function.body is not None and function.body.id == at.id:
                return function
        at = at.parent
    return None


def enclosing_statement(node: Node) -> Node | None:
    """The statement, or entry of an initialiser list, that a node is in."""
    at: Node | None = node
    while at is not None:
        if at.type.endswith("_statement") or at.type in ("declaration", "field_initializer"):
            return at
        if at.type in ("function_definition", "lambda_expression"):
            return None
        at = at.parent
    return None
