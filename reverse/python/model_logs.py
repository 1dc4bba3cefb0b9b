"""Statements that only log: a model has none of them, and they change nothing."""

from __future__ import annotations

from collections.abc import Container, Iterator

from tree_sitter import Node

from rebsync.reverse.python.log_words import HARMLESS, LOGS
from rebsync.reverse.python.py_callbacks import body_of
from rebsync.reverse.python.py_index import Scope
from rebsync.reverse.python.py_tree import field, named, text_of

_DESCRIBES = frozenset({"__repr__", "__str__"})
_STORING = frozenset({"named_expression", "await", "yield", "lambda"})


def only_logs(node: Node) -> bool:
    """Whether a statement only logs what is there already, perhaps under a condition."""
    match node.type:
        case "expression_statement" if len(named(node)) == 1:
            call = named(node)[0]
            is_log = call.type == "call" and LOGS.match(text_of(field(call, "function")))
            return bool(is_log) and _is_pure(field(call, "arguments"))
        case "if_statement":
            parts = [node, *node.children_by_field_name("alternative")]
            return all(map(_branch_only_logs, parts))
        case _:
            return False


def only_describes(function: Scope, members: Container[str]) -> bool:
    """Whether a function is `__repr__` or `__str__`, and only puts together what is there.

    `members` are the functions of the class, of which one may be a property that does something.
    """
    body = body_of(function)
    if function.name not in _DESCRIBES or len(body) != 1 or function.node.parent is None:
        return False
    values = named(body[0]) if body[0].type == "return_statement" else []
    is_plain = function.node.parent.type == "block" and len(values) == 1 and _is_pure(values[0])
    return is_plain and not any(
        text_of(field(a, "attribute")) in members for a in _reads(values[0])
    )


def _reads(node: Node) -> Iterator[Node]:
    if node.type == "attribute":
        yield node
    for child in node.named_children:
        yield from _reads(child)


def _branch_only_logs(part: Node) -> bool:
    condition = part.child_by_field_name("condition")
    body = field(part, "body" if part.type == "else_clause" else "consequence")
    inside = [n for n in named(body) if n.type not in ("comment", "pass_statement")]
    is_pure = condition is None or _is_pure(condition)
    return is_pure and bool(inside) and all(map(only_logs, inside))


def _is_pure(node: Node) -> bool:
    """Whether nothing happens where an expression is evaluated."""
    if node.type in _STORING:
        return False
    if node.type == "call":
        holder, _, name = text_of(field(node, "function")).rpartition(".")
        if name not in HARMLESS or holder in ("self", "super()"):
            return False
    return all(map(_is_pure, node.named_children))
