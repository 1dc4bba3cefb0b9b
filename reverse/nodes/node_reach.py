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
    called = code.handed_on() | _overridden(code, unit)
    served = {s.body.id for s in servers}
    for function in unit.functions:
        if function.body is None or function.node.id in found or function.body.id in served:
            continue
        special = function.name in unit.names or function.name.startswith(("~", "operator"))
        if not special and function.name in called:
            yield function


def reached(
    code: Code, unit: Unit, first: Sequence[CppFunction], servers: Sequence[Server]
) -> set[int]:
    """The ids of the functions that run: those that the start and the servers lead to."""
    by_name: dict[str, list[CppFunction]] = {}
    for function in unit.functions:
        by_name.setdefault(function.name, []).append(function)
    found = {f.node.id for f in first}
    calls = [code.calls_in(s.cpp, s.body) for s in servers] + [code.calls_of(f) for f in first]
    names = {c.name.rpartition("::")[2] for each in calls for c in each}
    waiting = [f for name in sorted(names) for f in by_name.get(name, ())]
    while waiting:
        function = waiting.pop()
        if function.node.id not in found:
            found.add(function.node.id)
            called = {c.name.rpartition("::")[2] for c in code.calls_of(function)}
            waiting += [f for name in called for f in by_name.get(name, ())]
    return found


def _overridden(code: Code, unit: Unit) -> set[str]:
    """The virtual functions of a class whose base is not in the files: that calls them."""
    known = set(code.classes) | _CALLS_NOTHING
    if all(base in known for above in unit.lineage for base in above.bases):
        return set()
    functions = (f for above in unit.lineage for f in above.functions)
    return {f.name for f in functions if f.overrides or text_of(f.node).startswith("virtual ")}
