"""Which containers of Python libraries may empty that no table knows: those that they get.

Such a function may keep a container, and take elements out of it whenever it likes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property

from rebsync.reverse.analysis.origins import AnyOrigin, LibraryOrigin, Origins
from rebsync.reverse.analysis.stores import CapturedVariable, Key, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import walk_all
from rebsync.reverse.libraries.endless import FINITE
from rebsync.reverse.libraries.outcomes import CallOutcome
from rebsync.reverse.libraries.routines import Language

_NOTHING = CallOutcome()
# What messages are made by: they take what they get as it is.
_MESSAGES = frozenset({"msg", "srv", "action", "Request", "Response"})


class ForeignEmptying:
    """The containers of one program."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins
        self._program = origins.graph.program
        self._table = origins.table

    @cached_property
    def handed(self) -> frozenset[Key]:
        """The names of what such functions get, by itself or by another name."""
        if self._table.language is not Language.PYTHON:
            return frozenset()
        found, edges = set[Key](), list[tuple[Key, Key]]()
        for name, node in walk_all(self._program):
            edges += self._same(node, name)
            if isinstance(node, s.Call) and self.is_foreign(node, name):
                found |= {k for a in node.arguments for k in _keys(a.value, name)}
        before = 0
        while len(found) != before:
            before = len(found)
            found |= {of for to, of in edges if to in found}
        return frozenset(found)

    def is_foreign(self, call: s.Call, function: str) -> bool:
        """Whether a call runs a function of a library that no table knows."""
        callee = call.callee
        if isinstance(callee, s.MethodCallee) and self._origins.methods_of_any(callee.name):
            return False
        return runs_unknown(self._origins, call, function, self._is_unknown)

    def _is_unknown(self, name: str) -> bool:
        parts = name.split(".")
        if parts[0] in FINITE or self._table.is_standard(name) or not _MESSAGES.isdisjoint(parts):
            return False
        return self._table.function(name) == _NOTHING

    def _same(self, node: object, function: str) -> Iterator[tuple[Key, Key]]:
        """Names that a node gives to what has another name: it stores, or calls with it."""
        match node:
            case s.Assign(target, value):
                to = key_of(target, function)
                yield from ((to, of) for of in _keys(value, function) if to is not None)
            case s.Call(_, callee, arguments):
                around = self._program.function(function)
                called = self._origins.graph.callee(callee, around).functions
                values = [a.value for a in arguments if _keys(a.value, function)]
                for name in called if values else ():
                    for parameter in self._program.function(name).parameters:
                        to = CapturedVariable(name, parameter.name)
                        yield from ((to, of) for v in values for of in _keys(v, function))
            case _:
                pass


def _keys(value: e.Expression, function: str) -> list[Key]:
    """The names of what a value is as it is, or has in a new container."""
    found = (key_of(part, function) for part in whole(value))
    return [key for key in found if key is not None]


def whole(value: e.Expression) -> Iterator[e.Expression]:
    """The values that an expression gives as they are, or in a container that it makes."""
    match value:
        case e.AddressOf(inner) | e.Dereference(inner) | e.Convert(_, inner) | e.Move(inner):
            yield from whole(inner)
        case e.Conditional(_, one, other) | e.And(one, other) | e.Or(one, other):
            yield from whole(one)
            yield from whole(other)
        case e.Build(_, elements):
            for each in elements:
                if not isinstance(each, e.Spread):
                    yield from whole(each)
        case _:
            yield value


def runs_unknown(
    origins: Origins, call: s.Call, function: str, is_unknown: Callable[[str], bool]
) -> bool:
    """Whether a call runs a function of a library that no table knows, by its name."""
    match call.callee:
        case s.LibraryCallee(name):
            return is_unknown(name)
        case s.ValueCallee(value):
            held = origins.of(value, function)
            return any(is_unknown(o.name) for o in held if isinstance(o, LibraryOrigin))
        case s.MethodCallee(receiver, name):
            if origins.table.method(None, name) != _NOTHING:
                return False
            held = origins.of(receiver, function)
            of = [o.name for o in held if isinstance(o, LibraryOrigin)]
            return AnyOrigin() in held or any(map(is_unknown, of))
        case _:
            return False
