"""Mutexes in generated C++ that a thread may lock again while it holds them, and wait for ever.

The locks of the standard library (`std::lock_guard` and its kin) hold from their declaration to the
end of the block. What else locks a mutex may hold it longer than any block shows.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, part, text_of

_LOCK = re.compile(r"(?:std::|boost::)?(?:lock_guard|unique_lock|scoped_lock|shared_lock)\b")
_MUTEX = re.compile(r"(?:mutable)?(?:(?:std|boost)::)?(?:timed_|shared_)?mutex")
_RECURSIVE = re.compile(r"(?:mutable)?(?:(?:std|boost)::)?recursive_(?:timed_)?mutex")
_WORD = re.compile(r"\w+")
_BY_HAND = frozenset({"lock", "lock_shared", "try_lock", "try_lock_for", "try_lock_until"})
_AGAIN = "this waits for ever where the lock is held already"
_HELD = "this holds a lock, and what is called may wait for the same one for ever"
_LONGER = "this may hold a lock for longer than its block"


@dataclass(frozen=True, slots=True)
class _Taken:
    """A lock that a function takes: the statement, the block that it holds in, the mutexes."""

    node: Node
    block: Node
    mutexes: frozenset[str]


def odd_locks(code: Code, owner: CppClass) -> Iterator[tuple[Cpp, Node, str]]:
    """The locks of a class that may make a thread wait for itself."""
    line = code.lineage(owner.name)
    fields = {f.name: "".join(text_of(f.type).split()) for c in line for f in c.fields}
    again = frozenset(n for n, type_ in fields.items() if _RECURSIVE.fullmatch(type_))
    functions = [f for c in line for f in code.functions_of(c) if f.body is not None]
    taken = {f.node.id: [*_taken_in(f, again)] for f in functions}
    if any(taken.values()):
        waits = _waiting(code, functions, taken)
        for function in functions:
            for node, why in _odd_in(code, function, taken[function.node.id], waits):
                yield function.cpp, node, why
    mutexes = {n for n, type_ in fields.items() if _MUTEX.fullmatch(type_)} | again
    for function in functions if mutexes else ():
        for call in code.calls_of(function):
            if call.name in _BY_HAND and call.on in mutexes:
                yield function.cpp, call.node, _LONGER


def _taken_in(function: CppFunction, again: frozenset[str]) -> Iterator[_Taken]:
    assert function.body is not None
    for node in inside(function.body, "declaration"):
        block = node.parent
        if block is not None and _LOCK.match("".join(text_of(part(node, "type")).split())):
            # What is declared, then the mutexes: the tree may take these for types of parameters.
            words = _WORD.findall(text_of(node).partition(text_of(part(node, "type")))[2])
            yield _Taken(node, block, frozenset(words[1:]) - again)


def _waiting(
    code: Code, functions: list[CppFunction], taken: Mapping[int, list[_Taken]]
) -> dict[str, frozenset[str]]:
    """The mutexes that functions lock, and those that they call: a fixpoint, by their names."""
    locks: dict[str, frozenset[str]] = {}
    for function in functions:
        own = frozenset(m for t in taken[function.node.id] for m in t.mutexes)
        locks[function.name] = locks.get(function.name, frozenset()) | own
    is_new = True
    while is_new:
        is_new = False
        for function in functions:
            of_called = (locks[c.name] for c in code.calls_of(function) if _is_own(c, locks))
            whole = locks[function.name].union(*of_called)
            is_new = is_new or whole != locks[function.name]
            locks[function.name] = whole
    return locks


def _odd_in(
    code: Code, function: CppFunction, taken: list[_Taken], waits: Mapping[str, frozenset[str]]
) -> Iterator[tuple[Node, str]]:
    for lock in taken:
        later = (t for t in taken if _is_held_at(lock, t.node) and t.mutexes & lock.mutexes)
        yield from ((t.node, _AGAIN) for t in later)
        called = (c for c in code.calls_of(function) if _is_own(c, waits))
        if any(_is_held_at(lock, c.node) and waits[c.name] & lock.mutexes for c in called):
            yield lock.node, _HELD


def _is_held_at(lock: _Taken, node: Node) -> bool:
    """Whether something stands behind a lock in the block that it holds in."""
    return lock.node.end_byte <= node.start_byte and node.end_byte <= lock.block.end_byte


def _is_own(call: CppCall, names: Mapping[str, object]) -> bool:
    """Whether a call may be one of the functions of the class; by its name alone."""
    return call.name in names and call.on in ("", "this")
