"""What may give elements without end, and what goes through that to its end.

`itertools.count`, `cycle` and `repeat`, `iter` of a function, objects of the program that are
iterators or have elements by index, and generators that loop; and what the library makes of these
one by one (`map`, `enumerate`). Who only asks for the next one ends; who wants all of them does
not: `list`, `sum`, `in`, `*values`.

What a library gives that no table knows may be anything: it has no end where something surely goes
through it (a loop, `list`), while most of it (`x in given`, `a, b = given`) is no iterator at all.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from rebsync.reverse.analysis.origins import ClassOrigin, LibraryOrigin, Origins
from rebsync.reverse.analysis.stores import AnyValue, CallResult, Key, Stored, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.program import Function, FunctionKind
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries import endless
from rebsync.reverse.libraries.routines import Language

_NAMED = e.Local | e.Temporary | e.Captured | e.Global | e.Attribute
_METHODS = ("__next__", "__getitem__")


class EndlessIterators:
    """The iterators of one program; C++ has none that have no end of their own.

    With `foreign` what comes of libraries that no table knows is one that has no end.
    """

    def __init__(self, origins: Origins, foreign: bool = False) -> None:
        self._origins = origins
        self._foreign = foreign
        self._graph = origins.graph
        self._program = origins.graph.program
        self._is_python = origins.table.language is Language.PYTHON

    def may_be(self, value: e.Expression, function: str) -> bool:
        """Whether a value may give elements without end when it is iterated."""
        return self._is_python and self._may_be(value, function, set())

    def gone_through(self, function: Function) -> Iterator[s.Statement | e.Expression]:
        """What in a body goes through such a value to its end, or as far as a `break`."""
        if not self._is_python:
            return
        for node in walk(function.body):
            known = (self.may_be(v, function.name) for v in self._wanted(node, function))
            given = (self._other.may_be(v, function.name) for v in self._iterated(node, function))
            if any(known) or any(given):
                yield node  # type: ignore[misc]

    @cached_property
    def _other(self) -> EndlessIterators:
        """The same, with what comes of libraries that no table knows."""
        return EndlessIterators(self._origins, True)

    def _iterated(self, node: Node, function: Function) -> Iterator[e.Expression]:
        """The values of which a node surely wants all elements, if they have any."""
        match node:
            case s.Call(_, callee, arguments):
                yield from (a.value for a in arguments if a.stars == 1)
                plain = [a.value for a in arguments if a.name is None and not a.stars]
                if self._libraries(callee, function.name) & endless.CONSUMING and len(plain) == 1:
                    yield from plain
            case s.Yield(_, value, True) | s.ForEach(_, value):
                yield value
            case e.Build(_, elements):
                yield from (p.operand for p in elements if isinstance(p, e.Spread))
            case _:
                pass

    def _wanted(self, node: Node, function: Function) -> Iterator[e.Expression]:
        """The values of which a node wants all elements."""
        match node:
            case s.Call(_, callee, arguments):
                yield from (a.value for a in arguments if a.stars)
                if self._wants_all(callee, function):
                    yield from (a.value for a in arguments if not a.stars)
            case s.Unpack(_, value) | s.Yield(_, value, True) | s.CompoundAssign(_, _, value):
                yield value
            case s.Assign(e.Index(_, e.Slice()), value) | s.ForEach(_, value):
                yield value
            case e.Build(_, elements):
                yield from (p.operand for p in elements if isinstance(p, e.Spread))
            case e.Binary(Operator.IN | Operator.NOT_IN, _, right):
                yield right
            case _:
                pass

    def _wants_all(self, callee: s.Callee, function: Function) -> bool:
        """Whether a call may go through what it gets: not where the program itself does that."""
        names = self._libraries(callee, function.name)
        if not names:
            return isinstance(callee, s.MethodCallee)
        return any(name not in endless.ONE_BY_ONE for name in names)

    def _libraries(self, callee: s.Callee, function: str) -> set[str]:
        """The functions of libraries that may be called."""
        match callee:
            case s.LibraryCallee(name):
                return {name}
            case s.ValueCallee(value):
                held = self._origins.of(value, function)
                return {o.name for o in held if isinstance(o, LibraryOrigin) and not o.of_object}
            case _:
                return set()

    # --- what values are -------------------------------------------------------------------------

    def _may_be(self, value: e.Expression, function: str, seen: set[Key]) -> bool:
        match value:
            case e.Conditional(_, one, other) | e.And(one, other) | e.Or(one, other):
                return any(self._may_be(v, function, seen) for v in (one, other))
            case e.Index(_, e.Slice()):
                return False
            case e.Index():
                return self._is_made
            case e.LibraryReference(name):
                return name in endless.STREAMS or (self._foreign and self._is_foreign(name))
            case _ if not isinstance(value, _NAMED):
                return False
        key = key_of(value, function)
        if key is None or key in seen:
            return False
        seen.add(key)
        stored = self._graph.stores.of(key)
        if not stored and isinstance(value, e.Attribute):
            return self._is_of_foreign(value.object, function, set())
        return any(self._is_stored(each, seen) for each in stored)

    def _is_foreign(self, name: str) -> bool:
        """Whether no table knows what a function of a library gives, or an object of it does."""
        return name.partition(".")[0] not in endless.FINITE and not (
            self._origins.table.is_standard(name)
            or name in self._program.functions
            or self._origins.table.function(name).gives
        )

    def _is_of_foreign(self, value: e.Expression, function: str, seen: set[Key]) -> bool:
        """Whether a value may be an object of a library that no table knows."""
        if not self._foreign:
            return False
        held = self._origins.of(value, function)
        if any(isinstance(o, LibraryOrigin) and self._is_foreign(o.name) for o in held):
            return True
        key = key_of(value, function)
        if key is None or key in seen:
            return False
        seen.add(key)
        for of, each in self._graph.stores.of(key):
            match each:
                case CallResult(s.Call(_, s.MethodCallee(receiver))):
                    if self._is_of_foreign(receiver, of, seen):
                        return True
                case _:
                    pass
        return False

    def _is_stored(self, stored: Stored, seen: set[Key]) -> bool:
        function, value = stored
        if self._is_own(stored):
            return True
        match value:
            case CallResult(call):
                return self._is_given(call, function, seen)
            case AnyValue():
                return self._is_made
            case _:
                return isinstance(value, e.Expression) and self._may_be(value, function, seen)

    def _is_own(self, stored: Stored) -> bool:
        """Whether a value may be an object of the program that says itself what comes next."""
        held = self._origins.of_stored(stored)
        names = {o.name for o in held if isinstance(o, ClassOrigin) and o.of_object}
        return any(self._origins.has_method(n, m) for n in names for m in _METHODS)

    def _is_given(self, call: s.Call, function: str, seen: set[Key]) -> bool:
        """Whether a call gives such a value."""
        given = [a.value for a in call.arguments]
        plain = [a for a in call.arguments if a.name is None]
        match call.callee:
            case s.MethodCallee(receiver, name) if name not in endless.FINITE_METHODS:
                if self._is_of_foreign(receiver, function, set()):
                    return True
            case _:
                pass
        for name in self._libraries(call.callee, function):
            if endless.makes(name, given) or (self._foreign and self._is_foreign(name)):
                return True
            if name not in endless.LAZY or endless.is_bounded(name, given):
                continue
            wants = all if name in endless.SHORTEST else any
            over = plain[name in endless.AFTER_FUNCTION :]
            if over and wants(self._is_argument(a, function, seen) for a in over):
                return True
        around = self._program.function(function)
        return any(map(self._is_returned, self._graph.callee(call.callee, around).functions))

    def _is_argument(self, argument: s.CallArgument, function: str, seen: set[Key]) -> bool:
        """Whether an argument is such a value, or one of those that `*values` stands for."""
        if argument.stars:
            return self._is_made
        return self._may_be(argument.value, function, set(seen))

    def _is_returned(self, name: str) -> bool:
        """Whether a function may give such a value; of a generator, if it loops."""
        if name not in self._returned:
            self._returned[name] = False  # while it is looked at
            function = self._program.function(name)
            nodes = list(walk(function.body))
            if function.kind is FunctionKind.GENERATOR:
                found = any(isinstance(n, s.Loop) for n in nodes)
                over = (n.iterable for n in nodes if isinstance(n, s.ForEach))
                handed = (n.value for n in nodes if isinstance(n, s.Yield) and n.delegates)
                values = [*over, *handed]
            else:
                returned = (n.value for n in nodes if isinstance(n, s.Return))
                found, values = False, [v for v in returned if v is not None]
            self._returned[name] = found or any(self._may_be(v, name, set()) for v in values)
        return self._returned[name]

    @cached_property
    def _returned(self) -> dict[str, bool]:
        return {}

    @cached_property
    def _is_made(self) -> bool:
        """Whether the program makes such a value anywhere: what it gets may be one then."""
        for name in self._program.functions:
            for node in walk(self._program.function(name).body):
                if isinstance(node, e.LibraryReference) and node.name in endless.MAKERS:
                    return True
                if isinstance(node, s.Call):
                    given = [a.value for a in node.arguments]
                    names = self._libraries(node.callee, name)
                    if any(endless.makes(n, given) for n in names):
                        return True
        return any(self._origins.methods_of_any(m) for m in _METHODS)


def has_own_iterator(origins: Origins, value: e.Expression, function: str) -> bool:
    """Whether a value is an iterator of the program's in C++, or has some."""
    classes = origins.own_classes(value, function)
    return any(
        origins.may_have_method(value, name) or any(origins.has_method(c, name) for c in classes)
        for name in ("operator++", "begin")
    )
