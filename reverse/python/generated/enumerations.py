"""Enumerations of Python: which members are numbered by `auto()`, and those before one."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.python.generated.module_variables import imported_as
from rebsync.reverse.syntax.py_index import CLASS, Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

INTEGERS, ENUM = "enum.IntEnum", "enum.Enum"


def is_auto(scope: Scope, value: Node) -> bool:
    """Whether a class gives a member the next number: `MOVE = auto()`."""
    if scope.kind != CLASS or value.type != "call" or named(field(value, "arguments")):
        return False
    return imported_as(scope.module, text_of(field(value, "function"))) == "enum.auto"


def names_before(owner: Scope, name: str) -> Iterator[str]:
    """The members of an enumeration that stand before one."""
    for statement in named(field(owner.node, "body")):
        inner = named(statement)[0] if statement.type == "expression_statement" else statement
        if inner.type != "assignment" or inner.child_by_field_name("right") is None:
            continue
        if text_of(field(inner, "left")) == name:
            return
        yield text_of(field(inner, "left"))
