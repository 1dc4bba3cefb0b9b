"""What a program of Python puts into containers, by the names of these."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from rebsync.records import dataclass
from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.stores import Key, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import Node, walk

_ONE = frozenset({"append", "appendleft", "add"})
_ALL = frozenset({"extend", "extendleft"})
# Functions that put their second argument into the first.
_PUTTING = frozenset({"heapq.heappush", "bisect.insort", "bisect.insort_left"})


@dataclass(frozen=True, slots=True)
class Put:
    """A value that a function puts into a container, under a key; or (`is_all`) its elements."""

    function: str
    value: e.Expression
    key: e.Expression | None = None
    is_all: bool = False


class ContainerStores:
    """The containers of one program."""

    def __init__(self, graph: CallGraph) -> None:
        self._program = graph.program

    def puts(self, key: Key) -> list[Put]:
        """What is put into a container under its name, anywhere."""
        return self._puts.get(key, [])

    @cached_property
    def _puts(self) -> dict[Key, list[Put]]:
        found: dict[Key, list[Put]] = {}
        for name in self._program.functions:
            for node in walk(self._program.function(name)):
                for container, put in _put(node, name):
                    key = key_of(container, name)
                    if key is not None:
                        found.setdefault(key, []).append(put)
        return found


def _put(node: Node, function: str) -> Iterator[tuple[e.Expression, Put]]:
    match node:
        case s.Insert(container, value, key):
            yield container, Put(function, value, key)
        case s.Assign(e.Index(container, index), value) if not isinstance(index, e.Slice):
            yield container, Put(function, value, index)
        case s.CompoundAssign(e.Index(container, index) as element, operator, value):
            if not isinstance(index, e.Slice):  # where one is missing, a counter gets it
                yield container, Put(function, e.Binary(operator, element, value), index)
        case s.Call(_, s.MethodCallee(container, method), (argument,)) if method in _ONE | _ALL:
            yield container, Put(function, argument.value, None, method in _ALL)
        case s.Call(_, s.MethodCallee(container, "insert"), (_, argument)):
            yield container, Put(function, argument.value)
        case s.Call(_, s.MethodCallee(container, "setdefault"), (key, argument)):
            yield container, Put(function, argument.value, key.value)
        case s.Call(_, s.LibraryCallee(name), (container, argument, *_)) if name in _PUTTING:
            yield container.value, Put(function, argument.value)
        case _:
            pass
