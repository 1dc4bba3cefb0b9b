"""Which values of Python can be written as JSON, and which can be copied, by their types."""

from __future__ import annotations

from collections.abc import Callable

from rebsync.reverse.analysis.python.value_types import (
    ContainerType,
    InstanceType,
    LibraryType,
    MessageType,
    OwnType,
    ValueType,
    ValueTypes,
    own_type,
)
from rebsync.reverse.libraries.attributes import TIMES

_PLAIN = frozenset({OwnType.NUMBER, OwnType.TEXT, OwnType.NONE})
_NESTED = frozenset({OwnType.LIST, OwnType.TUPLE, OwnType.MAPPING})


def is_written(types: ValueTypes, *, is_sorted: bool) -> bool:
    """Whether values of some types have a text in JSON; keys that are sorted are of one type."""
    return all(_is_written(type_, is_sorted) for type_ in types)


def _is_written(type_: ValueType | None, is_sorted: bool) -> bool:
    own = own_type(type_)
    if not isinstance(type_, ContainerType) or own not in _NESTED:
        return own in _PLAIN
    keys = frozenset(map(own_type, type_.elements))
    if own is OwnType.MAPPING and not (keys <= _PLAIN and (len(keys) < 2 or not is_sorted)):
        return False
    return is_written(
        type_.values if own is OwnType.MAPPING else type_.elements, is_sorted=is_sorted
    )


def is_copied(types: ValueTypes, is_object: Callable[[str], bool], *, is_deep: bool) -> bool:
    """Whether values of some types can be copied; `is_object` asks it of objects of a class."""
    return all(_is_copied(type_, is_object, is_deep) for type_ in types)


def _is_copied(type_: ValueType | None, is_object: Callable[[str], bool], is_deep: bool) -> bool:
    match type_:
        case ContainerType(None) | None:
            return False
        case ContainerType(_, elements, values):
            inner = elements | values if type_.own is OwnType.MAPPING else elements
            return not is_deep or is_copied(inner, is_object, is_deep=True)
        case InstanceType(name):
            return is_object(name)
        case LibraryType(name):
            return name.startswith("datetime.") or name in TIMES
        case MessageType() | OwnType():
            return True
