"""Values of rebsync as JSON and back: a table in which each row refers to rows before it.

The text holds names of classes from one closed table, and nothing else that means anything to
Python. What is one value in memory is one row, so that texts are there once, and identity lasts.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields
from enum import Enum
from functools import cache
from types import MappingProxyType
from typing import Any, TypeGuard

from rebsync.roundtrip.package.cache.types import MODULES, type_of
from rebsync.source import NOWHERE, Source

NO_SOURCES: Mapping[str, Source] = MappingProxyType({})
_ATOMS = (str, int, bool, float, type(None))
_CONTAINERS: dict[str, Callable[..., object]] = {
    "tuple": lambda *rows: rows,
    "list": lambda *rows: [*rows],
    "set": lambda *rows: {*rows},
    "frozenset": lambda *rows: frozenset(rows),
    "dict": lambda *rows: dict(zip(rows[::2], rows[1::2], strict=True)),
}


class NotSerialisable(Exception):
    """A value of a class that is not in the table, or a text that is no value."""


def serialised(value: object, sources: Mapping[str, Source] = NO_SOURCES) -> str:
    """A value as text, without the texts of `sources`, which go by their paths.

    NotSerialisable: something in it is of a class that is not in the table.
    """
    table = _Table(sources)
    table.add(value)
    try:
        return json.dumps(table.data(value), separators=(",", ":"))
    except ValueError as error:  # a number with more digits than Python writes
        raise NotSerialisable(str(error)) from None


def deserialised(text: str | bytes, sources: Mapping[str, Source] = NO_SOURCES) -> object:
    """The value that a text says. NotSerialisable: it says none."""
    try:
        kinds, values, rows, whole = json.loads(text)
        makers = [_maker(name, sources) for name in kinds]
        values.append(NOWHERE)
        row_of = values.__getitem__
        add = values.append
        for kind, *members in rows:
            add(makers[kind](*map(row_of, members)))
        return row_of(whole)
    except (ValueError, TypeError, LookupError, AttributeError, RecursionError) as error:
        raise NotSerialisable(str(error)) from None


def _maker(name: str, sources: Mapping[str, Source]) -> Callable[..., object]:
    if name == "source of":
        return sources.__getitem__
    return _CONTAINERS.get(name) or _of_class(name)


@cache
def _of_class(name: str) -> Callable[..., object]:
    found = type_of(name)
    return found.__members__.__getitem__ if issubclass(found, Enum) else found


@cache
def _members_of(kind: type[Any]) -> Callable[[Any], Iterable[object]]:
    """What gives the members of a value of a class. NotSerialisable: it is not in the table."""
    if kind is dict:
        return lambda value: (each for pair in value.items() for each in pair)
    if kind.__name__ in _CONTAINERS and kind.__module__ == "builtins":
        return iter
    if MODULES.get(kind.__name__) != kind.__module__:
        raise NotSerialisable(f"values of {kind.__module__}.{kind.__qualname__} are not kept")
    if issubclass(kind, Enum):
        return lambda value: (value.name,)
    names = tuple(f.name for f in fields(kind))
    return lambda value: [getattr(value, name) for name in names]


class _Table:
    """The rows so far; each refers to atoms by number, and to rows by the number inverted."""

    def __init__(self, sources: Mapping[str, Source]) -> None:
        self._sources = sources
        self._atoms: list[object] = []
        self._atom_numbers: dict[tuple[type, object], int] = {}
        self._kinds: dict[str, int] = {}
        self._rows: list[list[int]] = []
        self._numbers = {id(NOWHERE): 0}

    def add(self, value: object) -> None:
        """Adds a value after all that it is made of."""
        waiting: list[tuple[object, list[object] | None]] = [(value, None)]
        while waiting:
            current, members = waiting.pop()
            if members is not None:
                self._add_row(current, members)
            elif type(current) not in _ATOMS and id(current) not in self._numbers:
                members = list(self._members(current))
                waiting.append((current, members))
                waiting += [(member, None) for member in reversed(members)]

    def data(self, whole: object) -> tuple[list[str], list[object], list[list[int]], int]:
        """Kinds, atoms, rows, and the number of the whole; `NOWHERE` is counted before the rows."""
        number = self._reference(whole)
        first = len(self._atoms)
        rows = [[kind, *(n if n >= 0 else first + ~n for n in row)] for kind, *row in self._rows]
        return [*self._kinds], self._atoms, rows, number if number >= 0 else first + ~number

    def _members(self, value: object) -> Iterable[object]:
        if self._is_at_hand(value):
            return (value.path,)
        return _members_of(type(value))(value)  # type: ignore[arg-type]  # a class has a hash

    def _is_at_hand(self, value: object) -> TypeGuard[Source]:
        return isinstance(value, Source) and self._sources.get(value.path) is value

    def _add_row(self, value: object, members: list[object]) -> None:
        if id(value) in self._numbers:
            return
        kind = "source of" if self._is_at_hand(value) else type(value).__name__
        number = self._kinds.setdefault(kind, len(self._kinds))
        self._rows.append([number, *map(self._reference, members)])
        self._numbers[id(value)] = len(self._rows)

    def _reference(self, value: object) -> int:
        kind = type(value)
        if kind not in _ATOMS:
            return ~self._numbers[id(value)]
        key = (kind, repr(value) if kind is float else value)  # 0.0 and -0.0 are equal
        number = self._atom_numbers.setdefault(key, len(self._atoms))
        if number == len(self._atoms):
            self._atoms.append(value)
        return number
