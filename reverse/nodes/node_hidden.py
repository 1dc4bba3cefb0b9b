"""Hidden members, virtual calls of base constructors, and casts from `const`: none is read."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.bodies.scope import Record, Variable
from rebsync.reverse.nodes.node_bodies import Bodies
from rebsync.reverse.nodes.node_reach import called_by
from rebsync.reverse.syntax.cpp_calls import calls_in
from rebsync.reverse.syntax.cpp_declarations import CppField
from rebsync.reverse.syntax.cpp_index import CppClass, CppFunction

_CAST = b"const_cast<"


def note_hidden(bodies: Bodies) -> None:
    """Lists members that hide state of a base class, calls that constructors of base classes do not
    dispatch to the object's class, and casts that take `const` away."""
    for member in _hiding(bodies):
        if isinstance(bodies.scope(member.cpp, None).members.get(member.name), Variable | Record):
            why = f'"{member.name}" hides the member of that name in a base class'
            bodies.unread(member.cpp, member.node, why, "give one of them another name")
    for function, name in _dispatched(bodies):
        why = f'"{name}" of the base class runs here: the object is not yet of the class below'
        bodies.unread(function.cpp, function.node, why)
    for function in bodies.unit.functions:
        if function.body is None or _CAST not in (function.body.text or b""):
            continue
        for call in calls_in(function.body):
            if call.name.startswith("const_cast"):
                bodies.unread(function.cpp, call.node, "this may change what is constant")


def _dispatched(bodies: Bodies) -> Iterator[tuple[CppFunction, str]]:
    """Constructors of base classes that call what a class below has as well, with its name."""
    below: set[str] = set()
    for owner in bodies.unit.lineage:
        own = {f.name for f in bodies.code.functions_of(owner)} - {owner.name, f"~{owner.name}"}
        for constructor in bodies.unit.constructors(owner) if below else ():
            for name in sorted(_reached(bodies, owner, constructor) & below):
                yield constructor, name
        below |= own


def _reached(bodies: Bodies, owner: CppClass, first: CppFunction) -> set[str]:
    """The names of the functions of a class that a function may call, at once or through them."""
    own = {f.name: f for f in bodies.code.functions_of(owner)}
    found: set[str] = set()
    waiting = [first]
    while waiting:
        function = waiting.pop()
        for name in called_by(bodies.code, function, own.keys()) - found:
            found.add(name)
            waiting.append(own[name])
    return found


def _hiding(bodies: Bodies) -> Iterator[CppField]:
    seen: set[str] = set()
    for owner in reversed(bodies.unit.lineage):
        own = {f.name: f for f in (*owner.fields, *owner.others)}
        yield from (f for name, f in own.items() if name in seen)
        seen |= set(own)
