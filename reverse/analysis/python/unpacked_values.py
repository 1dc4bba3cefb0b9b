"""What variables hold that a sequence is unpacked into: its parts, where the program makes it.

By what is stored under the names of sequences anywhere, and what functions of the program give.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.python.argument_types import ArgumentTypes
from rebsync.reverse.analysis.stores import AnyValue, CallResult, CapturedVariable, Stored, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import walk

_DEEPEST = 5


class UnpackedValues:
    """The unpacked sequences of one program."""

    def __init__(self, graph: CallGraph, arguments: ArgumentTypes) -> None:
        self._graph = graph
        self._arguments = arguments
        self._unpacking: dict[str, list[s.Unpack]] = {}

    def of(self, value: e.Expression, function: str) -> Iterator[Stored]:
        """What a variable of a function gets of sequences that the program makes."""
        if not isinstance(value, e.Temporary):
            return
        for node in self._nodes(function):
            for at, target in enumerate(node.targets):
                if target == value and (node.rest is None or at < node.rest):
                    for around, made in self._made(node.value, function, _DEEPEST):
                        yield from ((around, part) for part in _part(made, at))

    def has_another_length(self, node: s.Unpack, function: str) -> bool:
        """Whether a sequence may be unpacked that has not as many parts as there are targets."""
        least = len(node.targets) - (node.rest is not None)
        for _, made in self._made(node.value, function, _DEEPEST):
            if any(isinstance(part, e.Spread) for part in made.elements):
                continue
            size = len(made.elements)
            if size < least or (node.rest is None and size > least):
                return True
        return False

    def _nodes(self, function: str) -> list[s.Unpack]:
        if function not in self._unpacking:
            body = self._graph.program.function(function)
            self._unpacking[function] = [n for n in walk(body) if isinstance(n, s.Unpack)]
        return self._unpacking[function]

    def _made(
        self, value: e.Expression, function: str, depth: int
    ) -> Iterator[tuple[str, e.Build]]:
        """The sequences that a value may be, as far as the program makes them."""
        match value:
            case e.Build():
                yield function, value
            case e.Conditional(_, one, other) | e.And(one, other) | e.Or(one, other):
                yield from self._made(one, function, depth)
                yield from self._made(other, function, depth)
            case e.Convert(_, of) | e.Copy(of) | e.Move(of):
                yield from self._made(of, function, depth)
            case _ if depth:
                key = key_of(value, function)
                if isinstance(key, CapturedVariable):
                    for around, given in self._arguments.arguments(key.function, key.name):
                        if isinstance(given, e.Build | e.Local | e.Temporary | e.Attribute):
                            yield from self._made(given, around, depth - 1)
                for around, stored in self._graph.stores.of(key) if key is not None else ():
                    match stored:
                        case CallResult(call):
                            yield from self._given(call, around, depth - 1)
                        case AnyValue():
                            yield from self._gone_through(value, around, depth - 1)
                        case e.Build() | e.Local() | e.Temporary() | e.Conditional():
                            yield from self._made(stored, around, depth - 1)
                        case e.Attribute() | e.Global() | e.Captured():
                            yield from self._made(stored, around, depth - 1)
                        case _:
                            pass

    def _given(self, call: s.Call, function: str, depth: int) -> Iterator[tuple[str, e.Build]]:
        """The sequences that functions of the program give."""
        around = self._graph.program.function(function)
        for name in self._graph.targets(call, around).functions:
            for node in walk(self._graph.program.function(name)):
                if isinstance(node, s.Return) and node.value is not None:
                    yield from self._made(node.value, name, depth)

    def _gone_through(
        self, value: e.Expression, function: str, depth: int
    ) -> Iterator[tuple[str, e.Build]]:
        """The sequences that are elements of what a loop goes through, or pairs that it makes."""
        for loop in walk(self._graph.program.function(function)):
            if isinstance(loop, s.ForEach) and loop.target == value:
                for around, made in self._made(loop.iterable, function, depth):
                    for part in made.elements:
                        if not isinstance(part, e.Spread):
                            yield from self._made(part, around, depth)
                yield from self._entries(loop.iterable, function)

    def _entries(self, value: e.Expression, function: str) -> Iterator[tuple[str, e.Build]]:
        """The entries of mappings, as pairs, where a value is `mapping.items()`."""
        key = key_of(value, function)
        for around, stored in self._graph.stores.of(key) if key is not None else ():
            match stored:
                case CallResult(s.Call(_, s.MethodCallee(of, "items"))):
                    name = key_of(of, around)
                    kept = self._graph.stores.of(name) if name is not None else [(around, of)]
                    for within, mapping in kept:
                        if isinstance(mapping, e.BuildMapping):
                            yield from ((within, pair) for pair in _pairs(mapping))
                case _:
                    pass


def _part(made: e.Build, at: int) -> Iterator[e.Expression]:
    """The part at an index, if no other is before it whose length is not known."""
    before = made.elements[: at + 1]
    if len(before) > at and not any(isinstance(part, e.Spread) for part in before):
        yield before[at]  # type: ignore[misc]


def _pairs(mapping: e.BuildMapping) -> Iterator[e.Build]:
    for entry in mapping.entries:
        if not isinstance(entry, e.Spread):
            yield e.Build(mapping.type, tuple(entry))
