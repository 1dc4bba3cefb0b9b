"""The members of a program's enumerations of Python: each is an object of its class."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.stores import Stored
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Class
from rebsync.reverse.libraries.outcome_classes import ENUMERATIONS

NO_MEMBERS: Mapping[str, Stored] = {}


class EnumerationMembers:
    """The enumerations of one program."""

    def __init__(self, graph: CallGraph) -> None:
        self._graph = graph

    def of(self, name: str) -> Mapping[str, Stored]:
        """The members of a class with their values; none if it is no enumeration."""
        return self._members.get(name, NO_MEMBERS)

    @cached_property
    def names(self) -> frozenset[str]:
        """The names of all members of all enumerations."""
        return frozenset(name for members in self._members.values() for name in members)

    @cached_property
    def _members(self) -> dict[str, dict[str, Stored]]:
        classes = self._graph.program.classes.values()
        are = (c for c in classes if not ENUMERATIONS.isdisjoint(self._graph.bases(c.name)))
        return {c.name: self._of(c) for c in are}

    def _of(self, class_: Class) -> dict[str, Stored]:
        """What the body of a class stores in its attributes, but for methods and `_names_`."""
        if class_.body is None:
            return {}
        found: dict[str, Stored] = {}
        for node in self._graph.program.function(class_.body).body:
            match node:
                case s.Assign(e.Attribute(e.ClassReference(), name), value):
                    if not name.startswith("_") and not isinstance(value, e.Closure):
                        found[name] = class_.body, value
                case _:
                    pass
        return found
