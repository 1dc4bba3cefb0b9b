"""Where objects behind pointers come from: provenance of what code calls methods of.

Who makes a node and hands it an object may have told that object of the node. What a library gives
knows of the node what it was told by calls, which are looked at by themselves.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import IntEnum
from functools import cached_property

from rebsync.reverse.analysis.fixpoint import Rounds
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import (
    AnyValue,
    CallResult,
    CapturedVariable,
    ElementOf,
    Key,
    ObjectValue,
    PartOf,
    Source,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.walk import walk, walk_all


class ObjectMaker(IntEnum):
    """Who made an object, from what is best known to what is least."""

    PROGRAM = 0  # the code that was read, which says its class
    LIBRARY = 1  # a function of a library
    OTHERS = 2  # somebody outside of what was read


# Methods of `pluginlib`, whose objects are of classes that a file names when the node runs.
_PLUGINS = frozenset(
    {"createInstance", "createUniqueInstance", "createSharedInstance", "createUnmanagedInstance"}
    | {"createClassInstance"}
)
# Methods of pointers and containers that give what these hold, and those that put something there.
_HOLDING = frozenset({"get", "lock", "at", "front", "back", "value", "begin", "find", "top"})
_PUTTING = frozenset(
    {"push_back", "push_front", "emplace_back", "emplace", "insert", "push", "reset", "assign"}
)
_VALUES = (e.Literal, e.Build, e.BuildRecord, e.BuildMapping, e.Closure, e.FunctionReference)


class Makers:
    """Who makes objects, by all that a program stores in variables."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins
        self._program = origins.graph.program
        self._rounds = Rounds[Key, ObjectMaker](self._variable, ObjectMaker.PROGRAM)

    def of(self, value: e.Expression, function: str) -> ObjectMaker:
        """Who made the object that a value of a function is, or leads to."""
        match value:
            case e.AddressOf(of) | e.Dereference(of) | e.Convert(_, of) | e.Copy(of) | e.Move(of):
                return self.of(of, function)
            case e.Conditional(_, then, otherwise):
                return max(self.of(then, function), self.of(otherwise, function))
            case _ if isinstance(value, _VALUES) or _is_object(getattr(value, "type", t.UNKNOWN)):
                return ObjectMaker.PROGRAM
            case e.Index(of):
                return self.of(of, function)
            case e.LibraryReference():
                return ObjectMaker.LIBRARY
        key = key_of(value, function)
        if key is None or (isinstance(key, CapturedVariable) and key.name == "this"):
            return ObjectMaker.OTHERS if key is None else ObjectMaker.PROGRAM
        return self._rounds.of(key)

    def _variable(self, key: Key, before: ObjectMaker) -> ObjectMaker:
        if isinstance(key, CapturedVariable) and self._index(key) is not None:
            return max(before, self._parameter(key))
        stored = [each for each in self._stored(key) if not _is_nothing(each[1])]
        return max((before, *map(self._of_stored, stored)) if stored else (ObjectMaker.OTHERS,))

    def _stored(self, key: Key) -> Iterator[Source]:
        yield from self._origins.graph.stores.sources(key)
        yield from self._put.get(key, ())

    def _of_stored(self, stored: Source) -> ObjectMaker:
        function, value = stored
        match value:
            case CallResult(call):
                return self._result(call, function)
            case ElementOf(of) | PartOf(of):
                return self.of(of, function)
            case ObjectValue():
                return ObjectMaker.PROGRAM
            case _ if isinstance(value, e.Expression):
                return self.of(value, function)
            case _:
                return ObjectMaker.OTHERS

    def _result(self, call: s.Call, function: str) -> ObjectMaker:
        """Who makes what a call gives."""
        match call.callee:
            case s.FunctionCallee(name):
                return self._given_by(name)
            case s.MethodCallee(receiver, name, str() as declared) if (
                found := self._origins.methods(declared, name)
            ):
                return max(self._given_by(f) for f in found)
            case s.LibraryCallee(name, receiver) | s.MethodCallee(receiver, name):
                last = name.partition("<")[0].rpartition("::")[2]
                if last in _PLUGINS:
                    return ObjectMaker.OTHERS
                if receiver is not None:
                    holder = self.of(receiver, function)
                    return holder if last in _HOLDING else max(holder, ObjectMaker.LIBRARY)
                if last.endswith("_cast") and call.arguments:
                    return self.of(call.arguments[-1].value, function)
        return ObjectMaker.LIBRARY

    def _given_by(self, name: str) -> ObjectMaker:
        if name not in self._program:
            return ObjectMaker.LIBRARY
        returned = [n.value for n in walk(self._program.function(name)) if isinstance(n, s.Return)]
        found = (self.of(v, name) for v in returned if v is not None)
        return max(found, default=ObjectMaker.PROGRAM)

    # --- parameters, and what is put into containers ----------------------------------------------

    def _index(self, key: CapturedVariable) -> int | None:
        """Which parameter a variable is; None for all others."""
        if key.function not in self._program:
            return None
        names = [p.name for p in self._program.function(key.function).parameters]
        return names.index(key.name) if key.name in names else None

    def _parameter(self, key: CapturedVariable) -> ObjectMaker:
        """What callers give; of callbacks, what the library gives that calls them."""
        index = self._index(key)
        found = [
            self.of(given[index], around)
            for around, given in self._given.get(key.function, ())
            if index is not None and index < len(given)
        ]
        if key.function in self._handed:
            found.append(ObjectMaker.LIBRARY)
        return max(found, default=ObjectMaker.OTHERS)

    @cached_property
    def _given(self) -> dict[str, list[tuple[str, list[e.Expression]]]]:
        """By each function what its calls give it, with the functions that these stand in."""
        found: dict[str, list[tuple[str, list[e.Expression]]]] = {}
        for around, node in walk_all(self._program):
            match node:
                case s.Call(_, s.FunctionCallee(name), arguments):
                    given = [a.value for a in arguments]
                    found.setdefault(name, []).append((around, given))
                case s.Call(_, s.MethodCallee(receiver, name, str() as of), arguments):
                    given = [receiver, *(a.value for a in arguments)]
                    for function in self._origins.methods(of, name):
                        found.setdefault(function, []).append((around, given))
                case s.Construct(target, _, arguments, str() as name) if target is not None:
                    given = [target, *(a.value for a in arguments)]
                    found.setdefault(name, []).append((around, given))
                case _:
                    pass
        return found

    @cached_property
    def _handed(self) -> frozenset[str]:
        """The functions that are handed on: who gets them calls them."""
        names = (e.FunctionReference, e.Closure)
        return frozenset(
            n.name if isinstance(n, e.FunctionReference) else n.function
            for _, n in walk_all(self._program)
            if isinstance(n, names)
        )

    @cached_property
    def _put(self) -> dict[Key, list[Source]]:
        """By each variable what is put into the container that it is, or into its elements."""
        found: dict[Key, list[Source]] = {}
        for around, node in walk_all(self._program):
            for holder, values in _put_by(node):
                key = key_of(holder, around)
                if key is not None:
                    found.setdefault(key, []).extend((around, v) for v in values)
        return found


def _is_nothing(value: object) -> bool:
    """Whether it is no object: null, or what is stored where an address is, which calls say."""
    return isinstance(value, AnyValue) or (isinstance(value, e.Literal) and value.value is None)


def _put_by(node: object) -> Iterator[tuple[e.Expression, list[e.Expression]]]:
    match node:
        case s.Assign(e.Index(of), value):
            yield of, [value]
        case s.Call(e.Index(of), _):
            yield of, [e.LibraryReference("")]
        case s.Call(_, s.LibraryCallee(name, receiver), arguments) if receiver is not None:
            if name.rpartition("::")[2] in _PUTTING:
                yield receiver, [a.value for a in arguments]
        case _:
            pass


def _is_object(type_: t.Type) -> bool:
    """Whether a value is an object itself, and neither leads to one nor may have what does."""
    match type_:
        case t.Unknown() | t.Reference() | t.FunctionType():
            return False
        case t.Container(_, elements):
            return bool(elements) and all(map(_is_object, elements))
        case t.Array(of, _) | t.Optional(of):
            return _is_object(of)
        case t.Record(name):
            return "ptr<" not in name and "&" not in name
        case _:
            return True
