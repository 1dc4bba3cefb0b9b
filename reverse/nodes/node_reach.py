"""Which functions of a unit run, as far as they can be followed from its servers and its start."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import text_of

# Bases that are not in the files and that call nothing but `onInit`.
_CALLS_NOTHING = frozenset({"Nodelet", "enable_shared_from_this", "noncopyable"})


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


def reached(
    code: Code, unit: Unit, first: Sequence[CppFunction], servers: Sequence[Server]
) -> set[int]:
    """The ids of the functions that run: those that the start and the servers lead to."""
    by_name: dict[str, list[CppFunction]] = {}
    for function in unit.functions:
        by_name.setdefault(function.name, []).append(function)
    found = {f.node.id for f in first}
    calls = [code.calls_in(s.cpp, s.body) for s in servers]
    names = {c.name.rpartition("::")[2] for each in calls for c in each}
    names.update(*map(code.names_called, first))
    waiting = [f for name in sorted(names) for f in by_name.get(name, ())]
    while waiting:
        function = waiting.pop()
        if function.node.id not in found:
            found.add(function.node.id)
            called = code.names_called(function)
            waiting += [f for name in called for f in by_name.get(name, ())]
    return found


def _overridden(code: Code, unit: Unit) -> set[str]:
    """The virtual functions of a class whose base is not in the files: that calls them."""
    known = set(code.classes) | _CALLS_NOTHING
    if all(base in known for above in unit.lineage for base in above.bases):
        return set()
    functions = (f for above in unit.lineage for f in above.functions)
    return {f.name for f in functions if f.overrides or text_of(f.node).startswith("virtual ")}
