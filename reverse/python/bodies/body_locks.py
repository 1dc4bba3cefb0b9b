"""Locks of people's Python that a thread may wait for while it holds them itself."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.libraries.tables.standard import LOCKS
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Frame
from rebsync.reverse.python.values.py_worth import Made
from rebsync.reverse.syntax.py_tree import field, named

_LOCK = re.compile(LOCKS)


def is_lock(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether an object is a lock, which only makes threads wait for each other."""
    ways = reading.values.ways(node, frame.scope)
    return bool(ways) and all(isinstance(w, Made) and _LOCK.fullmatch(w.by) for w in ways)


def waits_for_itself(reading: Reading, statement: Node, frame: Frame) -> bool:
    """Whether what `with lock:` runs may enter the same lock again, and so wait for ever."""
    return reading.form is None or reading.form.waits_for_itself(frame.py, statement)


def contexts_of(statement: Node) -> list[Node]:
    """What a `with` enters, without the names that it gives them."""
    found = []
    for item in named(named(statement)[0]):
        value = field(item, "value")
        while value.type in ("as_pattern", "parenthesized_expression") and value.named_children:
            value = value.named_children[0]
        found.append(value)
    return found
