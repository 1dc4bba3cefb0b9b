"""Which functions of a unit run, as far as they can be followed from its servers and its start."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence

from tree_sitter import Node

from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import text_of

# Bases that are not in the files and that call nothing but `onInit`.
_CALLS_NOTHING = frozenset({"Nodelet", "enable_shared_from_this", "noncopyable"})
_WORD = re.compile(r"\w+")


def unreached(
    code: Code, unit: Unit, first: Sequence[CppFunction], servers: Sequence[Server]
) -> Iterator[CppFunction]:
    """The functions that neither servers nor the start lead to, though some code names them."""
    found = reached(code, unit, first, servers)
    served = {s.body.id for s in servers}
    left = [
        function
        for function in unit.functions
        if function.body is not None
        and function.node.id not in found
        and function.body.id not in served
        and function.name not in unit.names
        and not function.name.startswith(("~", "operator"))
    ]
    if left:
        called = code.handed_on({f.name for f in left}) | _overridden(code, unit)
        yield from (f for f in left if f.name in called)


def called_by(code: Code, function: CppFunction, names: Collection[str]) -> frozenset[str]:
    """Which of some names a function calls: its text tells quickly of most that it does not."""
    if function.body is None or not _says(function.body, names):
        return frozenset()
    return code.names_called(function).intersection(names)


def _says(body: Node, names: Collection[str]) -> bool:
    """Whether one of some names, or of an operator or template its first word, is in a text."""
    text = body.text or b""
    words = (_WORD.search(name) for name in names)
    return any(word is None or word[0].encode() in text for word in words)


def reached(
    code: Code, unit: Unit, first: Sequence[CppFunction], servers: Sequence[Server]
) -> set[int]:
    """The ids of the functions that run: those that the start and the servers lead to."""
    by_name: dict[str, list[CppFunction]] = {}
    for function in unit.functions:
        by_name.setdefault(function.name, []).append(function)
    found = {f.node.id for f in first}
    calls = [code.calls_in(s.cpp, s.body) for s in servers if _says(s.body, by_name)]
    names = {c.name.rpartition("::")[2] for each in calls for c in each}
    names.update(*(called_by(code, function, by_name.keys()) for function in first))
    waiting = [f for name in sorted(names) for f in by_name.get(name, ())]
    while waiting:
        function = waiting.pop()
        if function.node.id not in found:
            found.add(function.node.id)
            called = called_by(code, function, by_name.keys())
            waiting += [f for name in called for f in by_name[name]]
    return found


def _overridden(code: Code, unit: Unit) -> set[str]:
    """The virtual functions of a class whose base is not in the files: that calls them."""
    known = set(code.classes) | _CALLS_NOTHING
    if all(base in known for above in unit.lineage for base in above.bases):
        return set()
    functions = (f for above in unit.lineage for f in above.functions)
    return {f.name for f in functions if f.overrides or text_of(f.node).startswith("virtual ")}


def all_functions(code: Code) -> list[CppFunction]:
    """The functions of classes, and what is defined outside of their bodies."""
    owned = [f for owner in code.classes.values() for f in code.functions_of(owner)]
    return [*owned, *(f for found in code.definitions.values() for f in found)]
