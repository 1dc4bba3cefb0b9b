"""What runs with objects though no call stands there: of their bases and members, of elements.

To make or end an object makes or ends what it consists of; what libraries have in containers they
compare, hash and copy by the operators of its class.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property

from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.program import Class

# Classes of the standard library by which containers keep their elements apart.
_COMPARING = ("hash", "less", "greater", "less_equal", "greater_equal", "equal_to")


class UnreadObjects:
    """Which functions objects of a program of C++ run, and which operators no file has."""

    def __init__(self, graph: CallGraph) -> None:
        self._graph = graph
        self._program = graph.program

    def parts(self, type_: t.Type) -> list[Class]:
        """The classes of the objects that a type is, and consists of."""
        waiting, found = [type_], dict[str, Class]()
        while waiting:
            match waiting.pop():
                case t.Record(name) if name in self._program.classes and name not in found:
                    found[name] = self._program.classes[name]
                    waiting += map(t.Record, self._graph.bases(name))
                    waiting += (f.type for f in found[name].fields)
                case t.Array(of, _) | t.Optional(of):
                    waiting.append(of)
                case t.Container(_, elements):
                    waiting += elements
                case t.Record(name) if "<" in name:
                    waiting += map(t.Record, name.partition("<")[2].rstrip(">").split(", "))
                case _:
                    pass
        return list(found.values())

    def made(self, type_: t.Type) -> Iterator[str]:
        """The constructors without a body of the objects that a type is, or consists of."""
        for owner in self.parts(type_):
            yield from self._undefined(f"{owner.name}::{owner.name.rpartition('::')[2]}")

    def ended(self, type_: t.Type, is_held: bool) -> Iterator[str]:
        """The destructors that the end of an object runs; if it is led to, of classes below too."""
        if isinstance(type_, t.Reference):
            type_ = type_.to if type_.ownership.value or not is_held else t.UNKNOWN
        below = [type_]
        if is_held and isinstance(type_, t.Record):
            below = [t.Record(c) for c in self._graph.family(type_.name)]
        for owner in (c for each in below for c in self.parts(each)):
            yield from self._undefined(f"{owner.name}::~{owner.name.rpartition('::')[2]}")
            if owner.destructor is not None:
                yield owner.destructor

    def _undefined(self, name: str) -> Iterator[str]:
        return (n for n in self._program.undefined if n == name or n.startswith(f"{name}("))

    # --- operators --------------------------------------------------------------------------------

    def operates_unread(self, types: Iterable[t.Type]) -> bool:
        """Whether a library that gets values of some types may run an operator without a body."""
        if not self._operators:
            return False
        types = list(types)
        if self._compares_unread and any(isinstance(each, t.Container) for each in types):
            return True
        classes = (c for each in types for c in self.parts(each))
        lines = ({c.name, *self._graph.bases(c.name)} for c in classes)
        return any(None in self._operators or line & self._operators for line in lines)

    @cached_property
    def _operators(self) -> frozenset[str | None]:
        """The classes that declare an operator without a body; None for a free one."""
        owners = set[str | None]()
        for name in self._program.undefined:
            outer, _, last = name.partition("(")[0].rpartition("::")
            if last.startswith("operator"):
                owners.add(outer if outer in self._program.classes else None)
        return frozenset(owners)

    @cached_property
    def _compares_unread(self) -> bool:
        """Whether a specialisation of what compares or hashes elements lacks a body."""
        lasts = {(o or "").partition("<")[0].rpartition("::")[2] for o in self._operators}
        return not lasts.isdisjoint(_COMPARING)

    @cached_property
    def enum_operators(self) -> frozenset[str]:
        """The operators outside of classes that may take an enumeration."""
        every = (*self._program.undefined, *self._program.functions)
        return frozenset(_last(name) for name in every if self.may_take_enum(name))

    def may_take_enum(self, name: str) -> bool:
        """Whether a function is an operator outside of classes that may take an enumeration."""
        owner = name.partition("(")[0].rpartition("::")[0]
        sign = _last(name).removeprefix("operator")
        if owner in self._program.classes or sign == _last(name) or sign[:1] in ("", '"', " "):
            return False
        if name not in self._program:
            return True
        kinds = (led_to(p.type) for p in self._program.function(name).parameters)
        return not any(isinstance(kind, t.Record) for kind in kinds)


def _last(name: str) -> str:
    """The last part of a name, without the types that tell overloads apart."""
    return name.partition("(")[0].rpartition("::")[2]


def led_to(type_: t.Type) -> t.Type:
    """What references of a type lead to."""
    while isinstance(type_, t.Reference):
        type_ = type_.to
    return type_
