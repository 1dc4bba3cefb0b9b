"""Which classes of Python have objects in which attributes cannot be stored.

Those of `__slots__`, of frozen data classes and of named tuples; see the data model of Python.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.stores import CallResult, ClassValue, Value, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import walk

_DATACLASS = "dataclasses.dataclass"
_TUPLES = frozenset({"typing.NamedTuple"})


class FixedAttributes:
    """The classes of one program."""

    def __init__(self, graph: CallGraph) -> None:
        self._graph = graph
        self._program = graph.program

    def refuses(self, name: str, attribute: str) -> bool:
        """Whether an object of a class takes no value for an attribute."""
        line = [name, *self._graph.bases(name)]
        if not self._frozen.isdisjoint(line) or not _TUPLES.isdisjoint(line):
            return True
        if any(c not in self._program.classes and c != "builtins.object" for c in line):
            return False
        own = [c for c in line if c in self._program.classes]
        slots = [self._slots(c) for c in own]
        if any(each is None for each in slots):
            return False
        methods = {p.name for c in own for p in self._program.classes[c].properties}
        return attribute not in methods.union(*(each or () for each in slots))

    def _slots(self, name: str) -> frozenset[str] | None:
        """The attributes that a class has place for; None where it has place for any."""
        body = self._program.classes[name].body
        for node in walk(self._program.function(body)) if body is not None else ():
            match node:
                case s.Assign(e.Attribute(_, "__slots__") | e.Local("__slots__"), value):
                    texts = (n.value for n in walk(value) if isinstance(n, e.Literal))
                    found = frozenset(text for text in texts if isinstance(text, str))
                    return None if "__dict__" in found else found
                case _:
                    pass
        return None

    @cached_property
    def _frozen(self) -> frozenset[str]:
        """The data classes that are decorated so that nothing is stored in their objects."""
        return frozenset(
            name
            for function in self._program.functions
            for node in walk(self._program.function(function))
            if isinstance(node, s.Call) and self._freezes(node.callee, function)
            for argument in node.arguments
            for name in self._classes(argument.value, function)
        )

    def _freezes(self, callee: s.Callee, function: str) -> bool:
        """Whether a decorator is that of frozen data classes."""
        key = key_of(callee.value, function) if isinstance(callee, s.ValueCallee) else None
        stored = self._graph.stores.of(key) if key is not None else []
        return any(_is_freezing(value) for _, value in stored)

    def _classes(self, value: e.Expression, function: str) -> Iterator[str]:
        key = key_of(value, function)
        for _, stored in self._graph.stores.of(key) if key is not None else ():
            if isinstance(stored, ClassValue):
                yield stored.name


def _is_freezing(value: Value) -> bool:
    match value:
        case CallResult(s.Call(_, s.LibraryCallee(name), arguments)) if name == _DATACLASS:
            return any(a.name == "frozen" and a.value != e.Literal(False) for a in arguments)
        case _:
            return False
