"""Objects of a program of C++ that libraries make: elements of containers, parts of pairs.

Which constructor runs is not looked for: each of the class may.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.libraries.outcome_classes import UNKNOWN_CLASS

_NAME = re.compile(r"[\w:]+")
# Classes whose objects have their parts from the start.
_WHOLE = re.compile(r"(?:std|boost)::(?:pair|tuple|array|make_\w+|in_place_type_t)<")
_GROWING = frozenset(
    {"emplace", "emplace_back", "emplace_front", "try_emplace", "resize", "assign", "operator[]"}
)


def made_by(origins: Origins, call: s.Call) -> Iterator[str]:
    """The constructors of the program that a call of a library may run."""
    callee = call.callee
    if not isinstance(callee, s.LibraryCallee):
        return
    constructors = origins.of_cpp.constructors
    if callee.name == UNKNOWN_CLASS:
        classes = origins.graph.program.classes
        for name in sorted(n for n, c in classes.items() if not c.complete):
            yield from constructors.get(name, ())
        return
    _, brackets, inner = callee.name.partition("<")
    if brackets and (call.arguments or _WHOLE.match(callee.name)):
        for name in _NAME.findall(inner):
            yield from constructors.get(name.removeprefix("::"), ())
    elif callee.receiver is not None and callee.name.rpartition("::")[2] in _GROWING:
        for name in _elements(getattr(callee.receiver, "type", t.UNKNOWN)):
            yield from constructors.get(name, ())


def _elements(type_: t.Type) -> Iterator[str]:
    """The classes of the elements of a container or optional."""
    match type_:
        case t.Container(_, elements):
            yield from (each.name for each in elements if isinstance(each, t.Record))
        case t.Optional(t.Record(name)):
            yield name
        case _:
            pass
