"""Of which types attributes are: of objects of the program, members, messages and handles."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.analysis.held_values import is_own
from rebsync.reverse.analysis.origins import ClassOrigin, Origins
from rebsync.reverse.analysis.python.argument_parsers import ArgumentParsers
from rebsync.reverse.analysis.python.argument_types import message_name
from rebsync.reverse.analysis.python.type_queries import TypeQueries
from rebsync.reverse.analysis.python.value_types import (
    A_NUMBER,
    A_TEXT,
    ANY_TYPE,
    NO_TYPES,
    ContainerType,
    InstanceType,
    LibraryType,
    MessageType,
    OwnType,
    ValueType,
    ValueTypes,
    sequence,
    union,
)
from rebsync.reverse.analysis.stores import CallResult, Stored
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.libraries.attributes import PARAMETER, attributes_of, held_in
from rebsync.reverse.libraries.outcome_classes import ENUMERATIONS

_OWN = {**{kind.value: kind for kind in OwnType}, "defaultdict": OwnType.MAPPING}
_NUMBERED = frozenset({"enum.IntEnum", "enum.IntFlag"})


class AttributeTypes:
    """The attributes of one program; `types` are those of the values in it."""

    def __init__(self, origins: Origins, types: TypeQueries) -> None:
        self._origins = origins
        self._graph = origins.graph
        self._program = origins.graph.program
        self._types = types
        self._parsers = ArgumentParsers(origins)

    def of(self, types: ValueTypes, of: e.Expression, name: str, function: str) -> ValueTypes:
        """The types of an attribute of what is of some types."""
        held = self._origins.of(of, function)
        if held and all(isinstance(o, ClassOrigin) and not o.of_object for o in held):
            members = (self._member(o.name, name) for o in held if isinstance(o, ClassOrigin))
            found = union(members)
            if found:
                return found
        found = union(self._of_type(type_, name) for type_ in types)
        is_told = all(isinstance(type_, MessageType | LibraryType) for type_ in types)
        is_told |= all(
            isinstance(each, InstanceType) and any(self._getters(each.name, name)) for each in types
        )
        if types and (is_told or self._enumerations(types)):
            return found
        if not self.has_own(of, function):
            return found | ANY_TYPE
        return found | self._types.of_member(name, self.receiver(of, function))

    def declared(self, value: e.Expression, function: str) -> list[t.Type]:
        """The types that a parameter or attribute, or an element of it, is declared with."""
        match value:
            case e.Local(name):
                around = self._program.function(function)
                return [p.type for p in around.parameters if p.name == name]
            case e.Attribute(of, name) if owner := self.receiver(of, function):
                classes = map(self._program.classes.get, self._graph.family(owner))
                fields = (f for c in classes if c is not None for f in c.fields)
                return [f.type for f in fields if f.name == name]
            case e.Index(of, index) if not isinstance(index, e.Slice):
                return [a.element for a in self.declared(of, function) if isinstance(a, t.Array)]
            case _:
                return []

    def receiver(self, value: e.Expression, function: str) -> str | None:
        """The class of the object that a method, or a function within it, is run for."""
        match value:
            case e.Local(name):
                around = self._program.function(function)
            case e.Captured(of, name):
                around = self._program.function(of)
            case _:
                return None
        return around.owner if name == around.receiver else None

    def operands(self, types: ValueTypes) -> ValueTypes:
        """The types of operands: members of enumerations of numbers are the numbers."""
        return frozenset(
            OwnType.NUMBER
            if isinstance(each, InstanceType) and self._is_number(each.name)
            else each
            for each in types
        )

    def _is_number(self, name: str) -> bool:
        line = (name, *self._graph.bases(name))
        classes = (self._program.classes[each] for each in line if each in self._program.classes)
        return not _NUMBERED.isdisjoint(line) and all(
            not each.operators and None not in each.bases for each in classes
        )

    def _enumerations(self, types: ValueTypes) -> bool:
        return all(isinstance(type_, InstanceType) and self._has_members(type_) for type_ in types)

    def _has_members(self, type_: InstanceType) -> bool:
        return not ENUMERATIONS.isdisjoint(self._graph.bases(type_.name))

    def _member(self, of: str, name: str) -> ValueTypes:
        """A member of an enumeration of the program; no types for any other attribute."""
        return frozenset((InstanceType(of),) if name in self._origins.enumerations.of(of) else ())

    def _of_type(self, type_: ValueType | None, name: str) -> ValueTypes:
        match type_:
            case MessageType(of):
                fields = self._origins.table.fields(of) or {}
                if name == "_connection_header":
                    return frozenset((ContainerType(OwnType.MAPPING, A_TEXT, A_TEXT),))
                return self.field(fields[name]) if name in fields else self._constant(of, name)
            case LibraryType("argparse.Namespace"):
                return self._parsers.of(name)
            case LibraryType(_, holds) if holds and name == "value":
                return holds
            case LibraryType(of):
                return self.of_class(held_in(f"{of}.{name}"))
            case InstanceType(of) if name in ("value", "_value_") and self._has_members(type_):
                stored = self._origins.enumerations.of(of).values()
                return union(A_NUMBER if _is_auto(v) else self._types.of_stored(v) for v in stored)
            case InstanceType() if name in ("name", "_name_") and self._has_members(type_):
                return A_TEXT
            case InstanceType() if self._has_members(type_):
                return ANY_TYPE
            case InstanceType(of):
                return union(map(self._types.result, self._getters(of, name)))
            case _:
                return NO_TYPES

    def _getters(self, of: str, name: str) -> Iterator[str]:
        """The functions that compute an attribute of objects of a class."""
        classes = self._program.classes
        for each in (of, *self._graph.bases(of)):
            for found in classes[each].properties if each in classes else ():
                if found.name == name and found.getter is not None:
                    yield found.getter

    def of_library(self, name: str) -> ValueTypes:
        """The types of what a library has under a full name: a constant of a message, or others."""
        of, _, last = name.rpartition(".")
        message = message_name(of)
        return self.of_class(held_in(name)) if message is None else self._constant(message, last)

    def _constant(self, message: str, name: str) -> ValueTypes:
        match self._origins.table.constant(message, name):
            case int():
                return A_NUMBER
            case str():
                return A_TEXT
            case _:
                return ANY_TYPE

    def field(self, type_: str) -> ValueTypes:
        """The types of the values of a field of a message, by its type in ROS."""
        plain, bracket, length = type_.partition("[")
        if bracket:
            # A fixed number of numbers is an array of numpy in ROS 2, bytes are no list.
            is_plain = length == "]" and plain not in ("uint8", "char", "byte")
            return sequence(OwnType.ARRAY if is_plain else None, self.field(plain))
        if plain == "string" or plain == "wstring":
            return A_TEXT
        return A_NUMBER if plain[:3] in ("int", "uin", "flo", "boo") else self.of_class(plain)

    def of_class(self, name: str) -> ValueTypes:
        """The types of an object of a library's class, of a message, or of one of Python's own."""
        if name == "parameters":
            return sequence(OwnType.LIST, frozenset((LibraryType(PARAMETER),)))
        if name == "builtins.Exception":
            return frozenset((LibraryType(name),))
        if name == "texts":
            return sequence(OwnType.LIST, A_TEXT)
        if name == "numbers":
            return sequence(OwnType.ARRAY, A_NUMBER)
        if name in _OWN:
            own = _OWN[name]
            return frozenset((own,)) if own in (OwnType.NUMBER, OwnType.TEXT) else _any_of(own)
        message = message_name(name) or name
        if self._origins.table.fields(message) is not None:
            return frozenset((MessageType(message),))
        return frozenset((LibraryType(name),)) if attributes_of(name) is not None else ANY_TYPE

    def has_own(self, of: e.Expression, function: str) -> bool:
        """Whether attributes of an object have what the program stores, as it is."""
        if not is_own(self._origins, of, function):
            return False
        classes = (o.name for o in self._origins.of(of, function) if isinstance(o, ClassOrigin))
        # Of an enumeration they are its members, which have that as their values.
        return all(ENUMERATIONS.isdisjoint(self._graph.bases(name)) for name in classes)


def _is_auto(stored: Stored) -> bool:
    """Whether the value of a member is a number that the enumeration chooses."""
    match stored[1]:
        case CallResult(s.Call(_, s.LibraryCallee("enum.auto"))):
            return True
        case _:
            return False


def _any_of(own: OwnType) -> ValueTypes:
    return frozenset((ContainerType(own, ANY_TYPE),))
