"""Objects and places of a language with values: what a pointer leads to, what a copy is."""

from __future__ import annotations

from collections.abc import Iterator, MutableMapping
from dataclasses import field
from typing import Any, TypeAlias

from rebsync.records import dataclass

# Any value of the interpreter.
Held: TypeAlias = Any


class Thrown(Exception):
    """Any value that is thrown."""

    def __init__(self, value: Held) -> None:
        super().__init__(value)
        self.value = value


@dataclass(eq=False, slots=True)
class Object:
    """An object of a class of the program, by its own class; a pointer to one is the object."""

    class_name: str
    fields: dict[str, Held] = field(default_factory=dict)


@dataclass(slots=True)
class Pointer:
    """A place of a value that is no object: a key of the variables, fields or elements there.

    `owner` and `kind` say what it is a place of, for those who note what is read and written.
    """

    space: Held
    key: Held
    owner: Held = None
    kind: str = ""

    def read(self) -> Held:
        """The value in the place."""
        return self.space[self.key]

    def write(self, value: Held) -> None:
        """Stores a value."""
        self.space[self.key] = value

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Pointer):
            return NotImplemented
        return self.space is other.space and bool(self.key == other.key)


@dataclass(eq=False, slots=True)
class Alias:
    """A variable that stands for an element."""

    pointer: Pointer


class Captured(MutableMapping[str, Held]):
    """The variables of an enclosing function as a closure has them: own ones, and places."""

    def __init__(self) -> None:
        self.own: dict[str, Held] = {}
        self.places: dict[str, Pointer] = {}

    def __getitem__(self, name: str) -> Held:
        return self.own[name] if name in self.own else self.places[name].read()

    def __setitem__(self, name: str, value: Held) -> None:
        if name in self.own:
            self.own[name] = value
        else:
            self.places[name].write(value)

    def __delitem__(self, name: str) -> None:
        raise KeyError(name)

    def __iter__(self) -> Iterator[str]:
        return iter({**self.own, **self.places})

    def __len__(self) -> int:
        return len(self.own) + len(self.places)
