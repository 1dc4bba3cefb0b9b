"""A `continue` within a `switch` of the model, in generated Python, where a switch is a loop.

A case says `case.go_on()` and leaves the switch; behind the switch, `if case.goes_on: continue`
goes on with the loop around it. Both together are the `continue`, neither is anything alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

from tree_sitter import Node

from rebsync.reverse.python.generated.py_types import call_parts, expression_in
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.py_tree import field, named, text_of

if TYPE_CHECKING:
    from rebsync.reverse.python.generated.statement_reader import ModelStatementReader


def goes_on(reader: ModelStatementReader, node: Node, after: Sequence[Node]) -> bool:
    """Whether a statement is `case.go_on()`, and the `break` of that switch is behind it.

    Raises `Unread` where nothing goes on with the loop behind the switch.
    """
    is_last = bool(after) and after[0].type == "break_statement"
    if not is_last or not reader.cases or _called(node) != f"{reader.cases[-1]}.go_on":
        return False
    switch = climb(node, lambda at: _is_switch(at, reader.cases[-1]))
    behind = _beside(switch, "next_named_sibling")
    if behind is None or _asked(behind) != reader.cases[-1]:
        raise reader.expressions.unread(node, "behind its switch, nothing goes on with the loop")
    return True


def says_so(reader: ModelStatementReader, node: Node) -> bool:
    """Whether an `if` is the second part of a `continue` that a switch before it has said."""
    name, before = _asked(node), _beside(node, "prev_named_sibling")
    has_else = node.child_by_field_name("alternative") is not None
    if not name or has_else or before is None or not _is_switch(before, name):
        return False
    body = [n for n in named(field(node, "consequence")) if n.type != "comment"]
    if not reader.cases:
        return [n.type for n in body] == ["continue_statement"]
    return len(body) == 2 and goes_on(reader, body[0], body[1:])


def _called(node: Node) -> str:
    inner = expression_in(node) or node
    called, _ = call_parts(inner) or ("", [])
    return called


def _is_switch(node: Node, name: str) -> bool:
    """`for name in switch(...)`."""
    is_loop = node.type == "for_statement" and text_of(field(node, "left")) == name
    return is_loop and _called(field(node, "right")) == "switch"


def _asked(node: Node) -> str:
    """The switch of which an `if` asks whether one of its cases goes on with the loop."""
    if node.type != "if_statement":
        return ""
    name, _, asked = text_of(field(node, "condition")).rpartition(".")
    return name if asked == "goes_on" else ""


def _beside(
    node: Node | None, side: Literal["next_named_sibling", "prev_named_sibling"]
) -> Node | None:
    """The statement before or behind one."""
    at: Node | None = getattr(node, side, None)
    while at is not None and at.type == "comment":
        at = getattr(at, side)
    return at
