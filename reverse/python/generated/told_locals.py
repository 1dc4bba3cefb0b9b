"""Locals of generated Python that only people are told of: messages, records, what clocks say."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from tree_sitter import Node

from rebsync.reverse.python.generated.logs import Looks
from rebsync.reverse.python.generated.module_variables import call_and_arguments
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import is_label, named, text_of

_LISTED = frozenset({"list_comprehension", "set_comprehension", "dictionary_comprehension"})


def told_locals(function: Scope, makers: frozenset[str], looks: Looks) -> frozenset[str]:
    """The locals of a function that are messages for people or records, or go by the clock."""
    found = set(_messages(function, makers))
    every = {
        name: [b.value for b in bindings]
        for name, bindings in function.names.items()
        if all(b.how == "value" and not b.path for b in bindings)
    }
    while fresh := {
        name
        for name, values in every.items()
        if name not in found
        and all(map(looks.is_pure, values))
        and any(v.type in _LISTED or _is_text(v) or _depends(v, found, looks) for v in values)
    }:
        found |= fresh
    return frozenset(name for name in found if _is_set_first(function.node, name))


def _is_text(value: Node) -> bool:
    """Whether a value is a text, or one of two: no model has any."""
    if value.type == "conditional_expression":
        first, _, other = named(value)
        return _is_text(first) and _is_text(other)
    return value.type in ("string", "concatenated_string")


def _is_set_first(function: Node, name: str) -> bool:
    """Whether a local is set before all else that names it, in the block that has all of that."""
    uses = [n for n in nodes_in(function) if n.type == "identifier" and text_of(n) == name]
    uses = [n for n in uses if not is_label(n)]
    statement = climb(uses[0], lambda n: n.type == "expression_statement")
    block = statement.parent if statement is not None else None
    if statement is None or block is None:
        return False
    if named(statement)[0].child_by_field_name("left") != uses[0]:
        return False
    return uses[-1].end_byte <= block.end_byte and len(uses) > 1


def _depends(value: Node, on: Collection[str], looks: Looks) -> bool:
    return any(
        looks.tells_time(n)
        or (n.type == "call" and looks.makes_record(n))
        or (n.type == "identifier" and text_of(n) in on)
        for n in nodes_in(value)
    )


def _messages(function: Scope, makers: frozenset[str]) -> Iterator[str]:
    """The locals of a function that are messages for people."""
    for name, bindings in function.names.items():
        values = [b.value for b in bindings]
        if values and all(v is not None and call_and_arguments(v)[0] in makers for v in values):
            yield name
