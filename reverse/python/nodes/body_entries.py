"""Functions that start the program of a node whose file only defines them, such as `main`.

A file that an installed program is made of (`talker = package.talker:main`) need not call it.
"""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.reverse.findings import Unread
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_units import scope_of
from rebsync.reverse.python.nodes.spinning import is_entry, own_nodes
from rebsync.reverse.syntax.py_index import FUNCTION, MODULE, Scope
from rebsync.reverse.syntax.py_tree import text_of

_UNKNOWN = "it is not known what runs the function that asks for this"


def entries(reading: Reading, within: str) -> list[Scope]:
    """What starts the functions of a module that ask ROS for something and that it does not call.

    What they ask for is listed where no program, or more than one, is known to start them.
    """
    code, module = reading.code, reading.unit.module
    asked = [(fact, scope_of(code, fact)) for fact in reading.unit.unit.facts]
    reached = _reached(reading, [module])
    left = [(f, s) for f, s in asked if s.kind != MODULE and id(_outermost(s)) not in reached]
    if not left:
        return []
    starts = [s for s in code.scopes.values() if s.module is module]
    starts = [s for s in starts if is_entry(s, reading.entries)]
    found = [s for s in starts if any(id(_outermost(o)) in _reached(reading, [s]) for _, o in left)]
    known = _reached(reading, found[:1])
    for fact, scope in left:
        if len(found) > 1 or id(_outermost(scope)) not in known:
            place = fact.site.place
            reading.findings.unreadable(place.source, Unread(place.span, _UNKNOWN), within)
    return found[:1]


def _outermost(scope: Scope) -> Scope:
    """The function at the top of a file that a function stands in."""
    while scope.parent is not None and scope.parent.kind != MODULE:
        scope = scope.parent
    return scope


def _reached(reading: Reading, starts: Iterable[Scope]) -> set[int]:
    """The functions that some code leads to, by the names in it."""
    by_name: dict[str, list[Scope]] = {}
    for scope in reading.code.scopes.values():
        if scope.module is reading.unit.module and scope.kind == FUNCTION:
            by_name.setdefault(scope.name, []).append(scope)
    found: set[int] = set()
    waiting = list(starts)
    while waiting:
        scope = waiting.pop()
        if id(scope) in found:
            continue
        found.add(id(scope))
        names = (text_of(n) for n in own_nodes(scope) if n.type == "identifier")
        waiting += [other for name in names for other in by_name.get(name, ())]
    return found
