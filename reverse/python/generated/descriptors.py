"""The descriptors of servers in modules of generated Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.generated.annotations import priority
from rebsync.reverse.python.generated.parameters import constant
from rebsync.reverse.python.generated.py_types import call_parts, string_value
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, text_of

_TAKES = ("name", "rank")
_PRIORITIES = {"priority": "priority", "global_priority": "globalPriority"}


def servers_of(module: Scope) -> dict[str, tuple[str, tuple[m.Annotation, ...]]]:
    """The descriptors of a module: `_X = Server("x", priority(1))`."""
    found = {}
    for name, bindings in module.names.items():
        for binding in bindings:
            parts = call_parts(binding.value) if binding.how == "value" else None
            if parts is None or parts[0] != "Server" or not parts[1]:
                continue
            server, *rest = given(parts[1])
            if (text := string_value(server)) is not None:
                found[name] = text, tuple(_priority(rest))
    return found


def given(arguments: list[Node]) -> list[Node]:
    """What a descriptor is made of: its name, and its priority, by place or in this order."""
    by_name = [a for a in arguments if a.type == "keyword_argument"]
    names = [text_of(field(a, "name")) for a in by_name]
    if names != [*_TAKES[len(arguments) - len(names) :]][: len(names)]:
        return arguments
    return [field(a, "value") if a in by_name else a for a in arguments]


def _priority(arguments: list[Node]) -> Iterator[m.Annotation]:
    for node in arguments:
        kind, given = call_parts(node) or ("", [])
        number = constant(given[0]) if len(given) == 1 else None
        if kind in _PRIORITIES and type(number) is int:
            yield priority(_PRIORITIES[kind], number)
