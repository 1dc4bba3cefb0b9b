"""Mutexes in C++ that a thread may lock again while it holds them, and wait for ever.

The locks of the standard library (`std::lock_guard` and its kin) hold from their declaration to the
end of the block; `m.lock();` holds to `m.unlock();` in the same block if nothing between leaves it.
What else locks a mutex may hold it longer than any block shows.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_kinds import LEAVES
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, part, text_of

_LOCK = re.compile(r"(?:std::|boost::)?(?:lock_guard|unique_lock|scoped_lock|shared_lock)\b")
_MUTEX = re.compile(r"(?:mutable)?(?:(?:std|boost)::)?(?:timed_|shared_)?mutex")
_RECURSIVE = re.compile(r"(?:mutable)?(?:(?:std|boost)::)?recursive_(?:timed_)?mutex")
_WORD = re.compile(r"\w+")
_BY_HAND = frozenset({"lock", "lock_shared", "try_lock", "try_lock_for", "try_lock_until"})
_STATEMENT = "expression_statement"
_LEAVES = (*LEAVES, "break_statement", "continue_statement")
_AGAIN = "this waits for ever where the lock is held already"
_HELD = "this holds a lock, and what is called may wait for the same one for ever"
_LONGER = "this may hold a lock for longer than its block"


@dataclass(frozen=True, slots=True)
class _Taken:
    """A lock that a function takes: the statement, the last one it holds for, the mutexes."""

    node: Node
    last: Node
    mutexes: frozenset[str]


def odd_locks(
    code: Code, lineage: Sequence[CppClass], functions: Sequence[CppFunction]
) -> Iterator[tuple[Cpp, Node, str]]:
    """The locks in the functions of a node that may make a thread wait for itself."""
    types = {v.name: v.type for of_name in code.variables.values() for v in of_name}
    types |= {f.name: f.type for c in lineage for f in c.fields}
    texts = {name: "".join(text_of(type_).split()) for name, type_ in types.items()}
    again = frozenset(n for n, type_ in texts.items() if _RECURSIVE.fullmatch(type_))
    mutexes = again | {n for n, type_ in texts.items() if _MUTEX.fullmatch(type_)}
    functions = [f for f in functions if f.body is not None]
    taken = {f.node.id: [*_taken_in(f, again), *_by_hand(code, f, mutexes)] for f in functions}
    waits = _waiting(code, functions, taken) if any(taken.values()) else {}
    for function in functions:
        of_function = taken[function.node.id]
        for node, why in _odd_in(code, function, of_function, waits) if of_function else ():
            yield function.cpp, node, why
        known = {t.node.id for t in of_function}
        for call in code.calls_of(function) if mutexes else ():
            if call.name in _BY_HAND and call.on in mutexes and _statement(call) not in known:
                yield function.cpp, call.node, _LONGER


def _taken_in(function: CppFunction, again: frozenset[str]) -> Iterator[_Taken]:
    assert function.body is not None
    for node in inside(function.body, "declaration"):
        block = node.parent
        if block is not None and _LOCK.match("".join(text_of(part(node, "type")).split())):
            # What is declared, then the mutexes: the tree may take these for types of parameters.
            words = _WORD.findall(text_of(node).partition(text_of(part(node, "type")))[2])
            yield _Taken(node, block, frozenset(words[1:]) - again)


def _by_hand(code: Code, function: CppFunction, mutexes: frozenset[str]) -> Iterator[_Taken]:
    """What `m.lock();` holds to `m.unlock();`, where that is sure to come."""
    for call in code.calls_of(function) if mutexes else ():
        statement = call.node.parent
        if call.name != "lock" or call.on not in mutexes or statement is None:
            continue
        behind = statement.next_named_sibling
        while behind is not None and not inside(behind, *_LEAVES):
            if _unlocks(behind, call.on):
                yield _Taken(statement, behind, frozenset({call.on}))
                break
            behind = behind.next_named_sibling


def _unlocks(statement: Node, mutex: str) -> bool:
    calls = [call_of(n) for n in named(statement)] if statement.type == _STATEMENT else []
    return any(c is not None and c.name == "unlock" and c.on == mutex for c in calls)


def _statement(call: CppCall) -> int:
    return call.node.parent.id if call.node.parent is not None else 0


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
    return lock.node.end_byte <= node.start_byte and node.end_byte <= lock.last.end_byte


def _is_own(call: CppCall, names: Mapping[str, object]) -> bool:
    """Whether a call may be one of the functions of the class; by its name alone."""
    return call.name in names and call.on in ("", "this")
