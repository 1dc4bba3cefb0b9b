"""Functions that run though no call of them stands in the text, besides what classes answer with.

Operators that are no methods, constructors that convert, what makes the values that a library fills
in, and the ends of Python's objects. Which of them a place runs is not looked for: all may.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import cached_property

from rebsync.reverse.analysis.origins import ClassOrigin, FunctionOrigin, LibraryOrigin, Origins
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import ImplicitCall
from rebsync.reverse.ir.program import Function, FunctionKind
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.routines import Language

# Those that call what they get later: for keys that are not there, and for fields without values.
_FILLING = frozenset({LibraryOrigin("collections.defaultdict"), LibraryOrigin("dataclasses.field")})


class SilentCalls:
    """The functions of one program."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins
        self._program = origins.graph.program
        self._is_python = origins.table.language is Language.PYTHON

    def called(self, function: Function) -> frozenset[str]:
        """The functions of the program that a function may run so."""
        found: set[str] = set()
        for node in walk(function):
            match node:
                case e.Binary(dynamic=True) | e.Unary(dynamic=True):
                    found |= self._operators
                case s.CompoundAssign(dynamic=True):
                    found |= self._operators
                case e.Convert(_, _, t.Record(name)):
                    found |= self._constructors.get(name, frozenset())
                case e.Index() | s.Call() | s.Construct():
                    found |= self._made
                case _:
                    pass
        if self._is_python:
            found |= self._origins.graph.implicit({ImplicitCall.DESTROY})
        return frozenset(found)

    def factories(
        self, function: Function, active: Collection[str]
    ) -> Iterator[tuple[str, e.Expression]]:
        """What a function may call of what libraries got, but for functions that run already."""
        if not self._filling:
            return
        if not any(isinstance(n, e.Index | s.Call | s.Construct) for n in walk(function)):
            return
        for around, value in self._filling:
            held = self._origins.of(value, around)
            if not any(isinstance(o, FunctionOrigin) and o.name in active for o in held):
                yield around, value

    @cached_property
    def _filling(self) -> tuple[tuple[str, e.Expression], ...]:
        """What people's own code gives those that call it later, with the functions around."""
        found: list[tuple[str, e.Expression]] = []
        for around in self._origins.own if self._is_python else ():
            for node in walk(self._program.function(around)):
                if isinstance(node, s.Call) and self._is_filling(node, around):
                    found += [(around, a.value) for a in node.arguments]
        return tuple(found)

    def _is_filling(self, call: s.Call, around: str) -> bool:
        match call.callee:
            case s.LibraryCallee(name):
                return LibraryOrigin(name) in _FILLING
            case s.ValueCallee(value):
                return not _FILLING.isdisjoint(self._origins.of(value, around))
            case _:
                return False

    @cached_property
    def _made(self) -> frozenset[str]:
        """The constructors of classes that libraries make objects of later."""
        names = {
            origin.name
            for around, value in self._filling
            for origin in self._origins.of(value, around)
            if isinstance(origin, ClassOrigin) and not origin.of_object
        }
        graph = self._origins.graph
        return frozenset(f for name in names for f in graph.construction(name).functions)

    @cached_property
    def _operators(self) -> frozenset[str]:
        """The operators of C++ that are no methods."""
        names = self._program.functions if not self._is_python else ()
        return frozenset(
            name
            for name in names
            if name.partition("(")[0].rpartition("::")[2].startswith("operator")
            and self._program.function(name).owner is None
        )

    @cached_property
    def _constructors(self) -> dict[str, frozenset[str]]:
        """The constructors of each class of C++."""
        found: dict[str, frozenset[str]] = {}
        for name in self._program.functions if not self._is_python else ():
            function = self._program.function(name)
            if function.kind is FunctionKind.CONSTRUCTOR and function.owner is not None:
                found[function.owner] = found.get(function.owner, frozenset()) | {name}
        return found
