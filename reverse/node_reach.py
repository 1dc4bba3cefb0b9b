"""Which functions of a unit run, as far as they can be followed from its servers and its start."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rebsync.reverse.cpp_calls import calls_in
from rebsync.reverse.cpp_index import Code, CppFunction
from rebsync.reverse.node_servers import Server
from rebsync.reverse.node_units import Unit


def unreached(
    code: Code, unit: Unit, first: Sequence[CppFunction], servers: Sequence[Server]
) -> Iterator[CppFunction]:
    """The functions that neither servers nor the start lead to, though some code names them."""
    reached = _reached(code, unit, first, servers)
    served = {s.body.id for s in servers}
    for function in unit.functions:
        if function.body is None or function.node.id in reached or function.body.id in served:
            continue
        special = function.name in unit.names or function.name.startswith(("~", "operator"))
        if not special and function.name in code.handed_on():
            yield function


def _reached(
    code: Code, unit: Unit, first: Sequence[CppFunction], servers: Sequence[Server]
) -> set[int]:
    by_name: dict[str, list[CppFunction]] = {}
    for function in unit.functions:
        by_name.setdefault(function.name, []).append(function)
    found = {f.node.id for f in first}
    bodies = [s.body for s in servers] + [f.body for f in first if f.body is not None]
    names = {c.name.rpartition("::")[2] for body in bodies for c in calls_in(body)}
    waiting = [f for name in sorted(names) for f in by_name.get(name, ())]
    while waiting:
        function = waiting.pop()
        if function.node.id not in found:
            found.add(function.node.id)
            called = {c.name.rpartition("::")[2] for c in code.calls_of(function)}
            waiting += [f for name in called for f in by_name.get(name, ())]
    return found
