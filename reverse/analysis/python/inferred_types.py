"""Of which types values of Python may be, by what the program stores: a type inference.

Flow-insensitive: the least fixpoint over all that is stored under each name, put into containers,
drawn from them, given for parameters and given back. What comes from elsewhere is of any type.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from enum import Enum
from typing import TypeAlias
from weakref import proxy

from rebsync.records import dataclass
from rebsync.reverse.analysis.fixpoint import Rounds
from rebsync.reverse.analysis.held_values import is_of_other_class
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.python.argument_types import ArgumentTypes
from rebsync.reverse.analysis.python.attribute_types import AttributeTypes
from rebsync.reverse.analysis.python.container_stores import ContainerStores
from rebsync.reverse.analysis.python.given_types import GivenTypes
from rebsync.reverse.analysis.python.operator_types import given_by
from rebsync.reverse.analysis.python.value_types import (
    A_NUMBER,
    A_TEXT,
    ANY_KEY,
    ANY_TYPE,
    NO_TYPES,
    ContainerType,
    InstanceType,
    LibraryType,
    OwnType,
    ValueType,
    ValueTypes,
    at_index,
    copied,
    elements_of,
    joined_items,
    limited,
    merged,
    of_declared,
    own_type,
    pair,
    sequence,
    union,
    written,
)
from rebsync.reverse.analysis.stores import (
    ANY_VALUE,
    AnyValue,
    CallResult,
    CapturedVariable,
    ClassValue,
    ElementOf,
    Key,
    Member,
    ObjectValue,
    PartOf,
    Source,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import COMPARISONS, Operator
from rebsync.reverse.ir.program import FunctionKind, Parameter, ParameterKind
from rebsync.reverse.ir.walk import walk

_CONTAINERS = {
    t.ContainerKind.SEQUENCE: OwnType.LIST,
    t.ContainerKind.TUPLE: OwnType.TUPLE,
    t.ContainerKind.QUEUE: OwnType.QUEUE,
    t.ContainerKind.SET: OwnType.SET,
    t.ContainerKind.MAPPING: OwnType.MAPPING,
}
_ADDED = frozenset({OwnType.TEXT, OwnType.BYTES, OwnType.LIST, OwnType.TUPLE, OwnType.QUEUE})
_DEEPEST = 3  # containers in one another; what is deeper is of any type


@dataclass(frozen=True, slots=True)
class OwnMember:
    """An attribute that methods of a class ask of their own object."""

    owner: str
    name: str


class _Contents(Enum):
    """What is put into any container."""

    ALL = "all"


Node: TypeAlias = Key | OwnMember | str | _Contents  # a name, or a function for its result


class InferredTypes:
    """The types of the values of one program."""

    def __init__(self, origins: Origins, arguments: ArgumentTypes) -> None:
        self._origins = origins
        self._graph = origins.graph
        self._arguments = arguments
        own = proxy(self)  # they are parts of this: no circle keeps the trees of a program
        self._containers = ContainerStores(origins.graph.program, own, _DEEPEST)
        self.attributes = AttributeTypes(origins, own)
        self._calls = GivenTypes(origins, own, self.attributes, arguments)
        self._rounds = Rounds[Node, ValueTypes](self._found, NO_TYPES)

    def of(self, value: e.Expression, function: str) -> ValueTypes:
        """The types of what an expression of a function may be; None has none."""
        match value:
            case e.Literal(None):
                return NO_TYPES
            case e.Literal(int() | float()) | e.Unary(Operator.NOT):
                return A_NUMBER
            case e.Literal(str()) | e.Format() | e.Global(_, "__name__" | "__file__"):
                return A_TEXT
            case e.Literal(bytes()):
                return frozenset((OwnType.BYTES,))
            case e.Build(t.Container(kind), elements):
                return self._built(_CONTAINERS[kind], elements, function)
            case e.BuildMapping(_, entries):
                return self._mapped(entries, function)
            case e.Conditional(_, one, other) | e.And(one, other) | e.Or(one, other):
                return self.of(one, function) | self.of(other, function)
            case e.Binary(operator) if operator in COMPARISONS:
                return A_NUMBER
            case e.Binary(operator, left, right):
                operands = (self.attributes.operands(self.of(v, function)) for v in (left, right))
                return computed(operator, *operands)
            case e.Unary(_, of):
                return A_NUMBER if self.of(of, function) == A_NUMBER else ANY_TYPE
            case e.Index(of, e.Slice()):
                return copied(self.of(of, function))
            case e.Index(of, index):
                at = index.value if isinstance(index, e.Literal) else None
                return at_index(self.of(of, function), at)
            case e.Attribute() if declared := self._declared(value, function):
                return declared
            case e.Attribute(of, name):
                return self.attributes.of(self.of(of, function), of, name, function)
            case e.LibraryReference(name):
                return self.attributes.of_library(name)
            case e.Local() | e.Temporary() | e.Captured() | e.Global():
                if owner := self.attributes.receiver(value, function):
                    return frozenset((InstanceType(owner),))
                key = key_of(value, function)
                return ANY_TYPE if key is None else self._rounds.of(key)
            case _:
                return ANY_TYPE

    def _declared(self, value: e.Attribute, function: str) -> ValueTypes:
        return union(map(of_declared, self.attributes.declared(value, function)))

    # --- containers ------------------------------------------------------------------------------

    def _built(
        self, own: OwnType, elements: Iterable[e.Expression | e.Spread], function: str
    ) -> ValueTypes:
        values = list(elements)
        if own is OwnType.TUPLE and not any(isinstance(v, e.Spread) for v in values):
            return pair(*(self.element(v, function) for v in values))
        return sequence(own, *(self.element(v, function) for v in values))

    def _mapped(
        self, entries: Iterable[tuple[e.Expression, e.Expression] | e.Spread], function: str
    ) -> ValueTypes:
        keys, values = NO_TYPES, NO_TYPES
        items = frozenset[tuple[object, ValueTypes]]()
        for entry in entries:
            if isinstance(entry, e.Spread):
                keys, values = keys | ANY_TYPE, values | ANY_TYPE
                items = joined_items(items, [(ANY_KEY, ANY_TYPE)])
                continue
            found = self.element(entry[1], function)
            keys, values = keys | self.element(entry[0], function), values | found
            items = joined_items(items, written(entry[0], found))
        return frozenset((ContainerType(OwnType.MAPPING, keys, values, None, items),))

    def element(self, value: e.Expression | e.Spread, function: str) -> ValueTypes:
        """The types of what stands in a container, None among them."""
        match value:
            case e.Spread(of):
                return elements_of(self.of(of, function))
            case e.Literal(None):
                return frozenset((OwnType.NONE,))
            case _:
                return self.of(value, function)

    def with_puts(self, key: Key, types: ValueTypes) -> ValueTypes:
        """The types of what is stored under a name, with what is put into that under any."""
        return self._containers.filled(key, types)

    def contents(self) -> ValueTypes:
        """What is put into containers, each time as one of its site."""
        return self._rounds.of(_Contents.ALL)

    # --- names -----------------------------------------------------------------------------------

    def _found(self, node: Node, before: ValueTypes) -> ValueTypes:
        """The types of what is stored under a name, or a function gives, of a bounded depth."""
        match node:
            case _Contents():
                return self._containers.contents(before)
            case str():
                found = self._result(node)
            case OwnMember(owner, name):
                found = self._named(Member(name), owner)
            case _:
                found = self._named(node)
        return merged(limited(found, _DEEPEST) | before)

    def of_member(self, name: str, owner: str | None) -> ValueTypes:
        """The types of an attribute, of objects of a class if methods of that ask their own."""
        return self._rounds.of(Member(name) if owner is None else OwnMember(owner, name))

    def _named(self, key: Key, owner: str | None = None) -> ValueTypes:
        sources = self.sources(key)
        if owner is not None and isinstance(key, Member):
            functions = {function for function, _ in sources}
            others = {f for f in functions if is_of_other_class(self._graph, owner, key, f)}
            sources = [each for each in sources if each[0] not in others]
        found = union(map(self.of_stored, sources)) | self.parameter(key)
        return self.with_puts(key, found if sources else found or ANY_TYPE)

    def sources(self, key: Key) -> list[Source]:
        """All that is stored under a name, but for what a function gets for a parameter."""
        sources = self._graph.stores.sources(key)
        if isinstance(key, CapturedVariable) and self.parameter(key):
            sources.remove((key.function, ANY_VALUE))
        if isinstance(key, Member):
            sources += self._arguments.fields(key.name)
        return sources

    def parameter(self, key: Key) -> ValueTypes:
        """The types of what calls and subscriptions give for a parameter, as far as known."""
        if not isinstance(key, CapturedVariable) or not (own := self._own_parameter(key)):
            return NO_TYPES
        if declared := of_declared(own.type):
            return declared
        if own.kind is ParameterKind.REST:
            return sequence(OwnType.TUPLE, ANY_TYPE)
        if own.kind is ParameterKind.NAMED_REST:
            return frozenset((ContainerType(OwnType.MAPPING, A_TEXT, ANY_TYPE),))
        if key.function in self._arguments.escaping:
            return ANY_TYPE
        given = self._arguments.arguments(key.function, key.name)
        messages = self._arguments.messages(key.function, key.name)
        found = union(map(self.of_stored, given))
        return found | union(map(self.attributes.of_class, messages))

    def constants(self, key: Key | None) -> list[object]:
        """What a parameter may be where all calls give constants; nothing if it may be more."""
        if not isinstance(key, CapturedVariable) or key.function in self._arguments.escaping:
            return []
        given = self._arguments.arguments(key.function, key.name)
        found: list[object] = [v.value for _, v in given if isinstance(v, e.Literal)]
        is_stored = self._graph.stores.of(key) != [(key.function, ANY_VALUE)]
        is_filled = bool(self._arguments.messages(key.function, key.name))
        return [] if is_stored or is_filled or len(found) < len(given) else found

    def _own_parameter(self, key: CapturedVariable) -> Parameter | None:
        """The parameter of a function that a name is."""
        program = self._graph.program
        parameters = program.function(key.function).parameters if key.function in program else ()
        return next((p for p in parameters if p.name == key.name), None)

    def of_stored(self, stored: Source) -> ValueTypes:
        """The types of what is stored somewhere."""
        function, value = stored
        match value:
            case CallResult(call):
                return self._calls.of(call, function)
            case ObjectValue(name):
                return frozenset((InstanceType(name),))
            case ElementOf(container):
                return elements_of(self.of(container, function))
            case PartOf(of, at):
                return at_index(self.of(of, function), at)
            case ClassValue(name) if self._origins.enumerations.of(name):
                return sequence(None, frozenset((InstanceType(name),)))
            case AnyValue() | ClassValue():
                return ANY_TYPE
            case _:
                return self.of(value, function)

    def result(self, function: str) -> ValueTypes:
        """The types of what a function of the program gives."""
        return self._rounds.of(function)

    def of_call(self, call: s.Call, function: str) -> ValueTypes:
        """The types of what a call in a function gives."""
        return self._calls.of(call, function)

    def mapped(self, value: e.Expression, function: str) -> ValueTypes:
        """The types of what a function gives that another calls for each element."""
        return self._calls.mapped(value, function)

    def _result(self, name: str) -> ValueTypes:
        body = self._graph.program.function(name)
        if body.kind is FunctionKind.GENERATOR:
            given = [n for n in walk(body) if isinstance(n, s.Yield)]
            found = (self.element(n.value, name) for n in given if n.value is not None)
            has_inner = any(n.delegates for n in given)
            return sequence(None, union(found) if not has_inner else ANY_TYPE)
        if body.kind is not FunctionKind.FUNCTION:
            return ANY_TYPE
        values = (n.value for n in walk(body) if isinstance(n, s.Return))
        return union(self.of(value, name) for value in values if value is not None)


def computed(operator: Operator, left: ValueTypes, right: ValueTypes) -> ValueTypes:
    """The types of what an operator gives for operands of some types; for None there is nothing.

    So a counter, of which the only other value is its own sum, is a number.
    """
    if NO_TYPES in (left, right):
        return NO_TYPES
    times = {given_by(operator, one, other) for one in left for other in right}
    if times and "" not in times:
        return union(A_NUMBER if t == "number" else frozenset((LibraryType(t),)) for t in times)
    if left == right == A_NUMBER:
        return A_NUMBER
    kinds = frozenset(map(own_type, left))
    if operator is Operator.ADD and kinds == frozenset(map(own_type, right)) and kinds <= _ADDED:
        return copied(left | right)
    if operator is Operator.FLOOR_MODULO and left == A_TEXT:
        return left
    if operator is Operator.MULTIPLY and right == A_NUMBER and kinds <= _ADDED:
        return frozenset(_repeated(type_) for type_ in left)
    return ANY_TYPE


def _repeated(type_: ValueType | None) -> ValueType | None:
    return (
        replace(type_, parts=None, sites=frozenset()) if isinstance(type_, ContainerType) else type_
    )
