"""The types of Python's values, as far as an analysis tells them apart."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from enum import Enum
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t


class OwnType(Enum):
    """A type of Python's own; numbers are one, with truth values."""

    NUMBER = "number"
    TEXT = "str"
    BYTES = "bytes"
    LIST = "list"
    TUPLE = "tuple"
    SET = "set"
    FROZEN = "frozenset"
    MAPPING = "dict"
    QUEUE = "deque"
    ARRAY = "array"  # the elements of a message's field: a list, a tuple or an array of numbers
    MODEL_ARRAY = "array of generated code"  # gone through, asked for one element; without a length
    MESSAGE = "message"  # of ROS: it has fields, and answers no operator
    NONE = "None"  # among the elements of containers; elsewhere None is looked for apart


@dataclass(frozen=True, slots=True)
class ContainerType:
    """A container with the types of its elements; those of a mapping are its keys.

    `own` is None for what is only gone through, as ranges. A tuple of known length has `parts`,
    and a mapping has `items` by the keys that the source writes, or by any. Its `sites` say where
    it may have been stored first, whatever it is called now.
    """

    own: OwnType | None
    elements: ValueTypes
    values: ValueTypes = frozenset((None,))
    parts: tuple[ValueTypes, ...] | None = None
    items: frozenset[tuple[object, ValueTypes]] = frozenset()
    sites: frozenset[object] = frozenset()


@dataclass(frozen=True, slots=True)
class LibraryType:
    """An object of a library's class of which a table has the attributes, by its full name.

    A parameter of a node is declared with a value of the types that it `holds`.
    """

    name: str
    holds: ValueTypes = frozenset()


@dataclass(frozen=True, slots=True)
class MessageType:
    """A message of ROS of which the fields are known: `std_msgs/Int32`."""

    name: str


@dataclass(frozen=True, slots=True)
class InstanceType:
    """An object of a class of the program."""

    name: str


# In a set of types None is a value that may be of any type.
ValueType: TypeAlias = OwnType | ContainerType | LibraryType | MessageType | InstanceType
ValueTypes: TypeAlias = "frozenset[ValueType | None]"
ANY_TYPE: ValueTypes = frozenset((None,))
NO_TYPES: ValueTypes = frozenset()
A_NUMBER: ValueTypes = frozenset((OwnType.NUMBER,))
A_TEXT: ValueTypes = frozenset((OwnType.TEXT,))
CHANGING = (OwnType.LIST, OwnType.QUEUE, OwnType.SET, OwnType.MAPPING)  # which are filled later
ANY_KEY = object()  # of an item whose key the source does not write


def own_type(type_: ValueType | None) -> OwnType | None:
    """The type of Python's own that a type is; None for any other."""
    match type_:
        case ContainerType(own):
            return own
        case OwnType():
            return type_
        case MessageType():
            return OwnType.MESSAGE
        case _:
            return None


def sequence(own: OwnType | None, *elements: ValueTypes) -> ValueTypes:
    """A container with elements of some types."""
    return frozenset((ContainerType(own, union(elements)),))


def pair(*parts: ValueTypes) -> ValueTypes:
    """A tuple with some parts."""
    return frozenset((ContainerType(OwnType.TUPLE, union(parts), parts=parts),))


def union(types: Iterable[ValueTypes]) -> ValueTypes:
    """A value of the one or the other types."""
    return NO_TYPES.union(*types)


def elements_of(types: ValueTypes) -> ValueTypes:
    """The types of what is gone through in values of some types, None among them left out."""
    return union(map(_elements, types)) - {OwnType.NONE}


def _elements(type_: ValueType | None) -> ValueTypes:
    match type_:
        case ContainerType(_, elements):
            return elements
        case OwnType.TEXT:
            return A_TEXT
        case OwnType.BYTES:
            return A_NUMBER
        case _:
            return ANY_TYPE


def at_index(types: ValueTypes, index: object) -> ValueTypes:
    """The types of what stands at an index that the source writes, or (None) at any."""
    return union(_at(type_, index) for type_ in types) - {OwnType.NONE}


def _at(type_: ValueType | None, index: object) -> ValueTypes:
    match type_:
        case ContainerType(OwnType.MAPPING, _, values, _, items):
            found = [of for key, of in items if key == index]
            others = [of for key, of in items if key is ANY_KEY]
            return union(found + others) if found else _of_one(values, index)
        case ContainerType(_, _, _, tuple() as parts) if isinstance(index, int):
            return parts[index] if -len(parts) <= index < len(parts) else ANY_TYPE
        case ContainerType(_, elements):
            return _of_one(elements, index)
        case OwnType.TEXT:
            return A_TEXT
        case OwnType.BYTES:
            return A_NUMBER
        case _:
            return ANY_TYPE


def _of_one(elements: ValueTypes, index: object) -> ValueTypes:
    """The types of one element by its index; it is not told which, where they are of several."""
    is_mixed = len(set(map(own_type, elements - {OwnType.NONE}))) > 1
    return ANY_TYPE if is_mixed and index is not None else elements


def values_of(types: ValueTypes) -> ValueTypes:
    """The types of the values of mappings."""
    found = (t.values if isinstance(t, ContainerType) else ANY_TYPE for t in types)
    return union(found) - {OwnType.NONE}


def limited(types: ValueTypes, depth: int) -> ValueTypes:
    """Types in which containers stand in one another to some depth; deeper is any type."""
    return frozenset(_shallow(type_, depth) for type_ in types)


def _shallow(type_: ValueType | None, depth: int) -> ValueType | None:
    if not isinstance(type_, ContainerType):
        return type_
    if not depth:
        return ContainerType(type_.own, ANY_TYPE, sites=type_.sites)
    return inside(type_, lambda types: limited(types, depth - 1))


def inside(type_: ContainerType, change: Callable[[ValueTypes], ValueTypes]) -> ContainerType:
    """A container with a change of what is in it."""
    parts = None if type_.parts is None else tuple(map(change, type_.parts))
    items = frozenset((key, change(of)) for key, of in type_.items)
    elements, values = change(type_.elements), change(type_.values)
    return replace(type_, elements=elements, values=values, parts=parts, items=items)


def sited(types: ValueTypes, name: object, depth: int = 0) -> ValueTypes:
    """Types in which containers that were stored nowhere before have a name as their site."""
    return frozenset(_sited(t, name, depth) if isinstance(t, ContainerType) else t for t in types)


def _sited(type_: ContainerType, name: object, depth: int) -> ContainerType:
    found = inside(type_, lambda types: sited(types, name, depth + 1))
    if found.sites or found.own not in CHANGING:
        return found
    return replace(found, sites=frozenset(((name, depth, found.own),)))


def copied(types: ValueTypes) -> ValueTypes:
    """Types of new containers with the same elements."""
    known = {t: replace(t, sites=frozenset()) for t in types if isinstance(t, ContainerType)}
    return frozenset(known.get(t, t) if isinstance(t, ContainerType) else t for t in types)


def merged(types: ValueTypes) -> ValueTypes:
    """Types with one container of each own type, which holds what any of them does."""
    found: dict[OwnType | None, ContainerType] = {}
    for type_ in types:
        if isinstance(type_, ContainerType):
            known = found.get(type_.own)
            found[type_.own] = type_ if known is None else _joined(known, type_)
    return frozenset(found.values()) | {t for t in types if not isinstance(t, ContainerType)}


def _joined(one: ContainerType, other: ContainerType) -> ContainerType:
    parts = None
    if one.parts is not None and other.parts is not None and len(one.parts) == len(other.parts):
        parts = tuple(merged(a | b) for a, b in zip(one.parts, other.parts, strict=True))
    elements, values = merged(one.elements | other.elements), merged(one.values | other.values)
    items, sites = joined_items(one.items, other.items), one.sites | other.sites
    return ContainerType(one.own, elements, values, parts, items, sites)


def joined_items(
    one: frozenset[tuple[object, ValueTypes]], other: Iterable[tuple[object, ValueTypes]]
) -> frozenset[tuple[object, ValueTypes]]:
    """The items of mappings, each of which may be either."""
    found = dict(one)
    for key, types in other:
        found[key] = merged(found.get(key, NO_TYPES) | types)
    return frozenset(found.items())


def written(key: e.Expression, types: ValueTypes) -> Iterator[tuple[object, ValueTypes]]:
    """An item of a mapping by the key that the source writes, or by any."""
    yield key.value if isinstance(key, e.Literal) else ANY_KEY, types


def of_declared(type_: t.Type) -> ValueTypes:
    """The type of a value that is declared with one; none where that says nothing."""
    match type_:
        case t.Integer() | t.Float() | t.Truth():
            return A_NUMBER
        case t.Text():
            return A_TEXT
        case t.Array(element):
            return sequence(OwnType.MODEL_ARRAY, of_declared(element) or ANY_TYPE)
        case t.RosMessage(name):
            return frozenset((MessageType(name),))
        case _:
            return NO_TYPES
