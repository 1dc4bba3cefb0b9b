"""Locks of people's Python that a thread may wait for while it holds them itself."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations

from tree_sitter import Node

from rebsync.reverse.libraries.tables.standard import LOCKS
from rebsync.reverse.python.body_reading import Reading
from rebsync.reverse.python.body_scope import Frame
from rebsync.reverse.python.py_index import Scope
from rebsync.reverse.python.py_tree import field, named, nodes_in, text_of
from rebsync.reverse.python.py_worth import Made

_LOCK = re.compile(LOCKS)
_REENTRANT = re.compile(r"threading\.RLock")


def is_lock(reading: Reading, node: Node, frame: Frame) -> bool:
    """Whether an object is a lock, which only makes threads wait for each other."""
    return _is_made_by(reading, node, frame, _LOCK)


def waits_for_itself(reading: Reading, statement: Node, frame: Frame) -> bool:
    """Whether what `with lock:` runs may enter the same lock again, and so wait for ever.

    What is called is looked for by its name alone; two locks are two where objects make both.
    """
    locks = locks_of(statement)
    held = [n for n in locks if not _is_made_by(reading, n, frame, _REENTRANT)]
    if any(_may_be_one(reading, *pair) for pair in combinations(locks, 2) if set(pair) & set(held)):
        return True
    waiting, seen = [field(statement, "body")] if held else [], set[str]()
    while waiting:
        for node in nodes_in(waiting.pop()):
            if node.type == "with_statement" and any(
                _may_be_one(reading, a, b) for a in locks_of(node) for b in held
            ):
                return True
            name = text_of(node) if node.type == "identifier" else ""
            if name == "acquire":
                return True
            if name and name not in seen:
                seen.add(name)
                waiting += [s.node for s in _functions(reading, name)]
    return False


def locks_of(statement: Node) -> list[Node]:
    """What a `with` enters, without the names that it gives them."""
    found = []
    for item in named(named(statement)[0]):
        value = field(item, "value")
        while value.type in ("as_pattern", "parenthesized_expression") and value.named_children:
            value = value.named_children[0]
        found.append(value)
    return found


def _is_made_by(reading: Reading, node: Node, frame: Frame, by: re.Pattern[str]) -> bool:
    ways = reading.values.ways(node, frame.scope)
    return bool(ways) and all(isinstance(w, Made) and by.fullmatch(w.by) for w in ways)


def _functions(reading: Reading, name: str) -> Iterator[Scope]:
    yield from reading.code.methods.get(name, ())
    for module in reading.code.modules.values():
        bound = (b for b in module.names.get(name, ()) if b.how == "scope")
        yield from (reading.code.scope_of(b.node, module.py) for b in bound)


def _may_be_one(reading: Reading, one: Node, other: Node) -> bool:
    """Whether two expressions may be the same lock."""
    names = [text_of(each).removeprefix("self.") for each in (one, other)]
    return names[0] == names[1] or not all(_is_own(reading, n) for n in names)


def _is_own(reading: Reading, name: str) -> bool:
    """Whether an attribute of the node only gets what a call has just made."""
    bindings = [b for s in reading.unit.lineage for b in s.attributes.get(name, ())]
    return bool(bindings) and all(b.value is not None and b.value.type == "call" for b in bindings)
