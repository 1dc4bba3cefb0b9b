"""Where statements about members stand: the function around them, and whether it makes one."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.python.generated.slicing.candidates import SET_UP
from rebsync.reverse.syntax.ancestors import functions_around
from rebsync.reverse.syntax.py_tree import field, named, text_of


def makes_member(statement: Node, name: str) -> bool:
    """Whether a statement of the constructor makes the member."""
    inner = named(statement)[0]
    function = _enclosing(statement)
    is_first = function is not None and text_of(field(function, "name")) in SET_UP
    left = text_of(field(inner, "left")) if inner.type == "assignment" else ""
    return (is_first and left == f"self.{name}") or (function is None and left == name)


def name_around(node: Node) -> str:
    """The function that something is in, by its name."""
    function = _enclosing(node)
    return text_of(field(function, "name")) if function is not None else ""


def _enclosing(node: Node) -> Node | None:
    return next(functions_around(node), None)


def function_around(node: Node) -> int:
    """The function that something is in, by its node."""
    found = _enclosing(node)
    return found.id if found is not None else 0
