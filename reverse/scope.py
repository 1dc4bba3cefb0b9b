"""What the names in the body of a C++ function stand for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from typing import Literal, TypeAlias

from tree_sitter import Node

from rebsync.model import Expression, Name
from rebsync.records import dataclass
from rebsync.reserved import RESERVED, uncarry_local
from rebsync.reverse.cpp_tree import Cpp


@dataclass(frozen=True, slots=True)
class Variable:
    """A state variable, a known rebec or a constant of the model."""

    name: str


@dataclass(frozen=True, slots=True)
class Runtime:
    """A member through which a class talks to the run-time part of generated code."""

    kind: Literal["mailbox", "drive", "sensor"]


Member: TypeAlias = Variable | Runtime


@dataclass(frozen=True, slots=True)
class Called:
    """A local method, or a message server, by its name in the model."""

    name: str
    server: bool = False


@dataclass(frozen=True, slots=True)
class Sends:
    """A function that fills a message from its arguments and sends it.

    To the known rebec `known`; or to itself, `known` being "self"; or, `known` being None, to the
    rebec that the first argument names. The last argument, if there is one more, is the time.
    """

    known: str | None
    server: str
    arguments: int


Function: TypeAlias = Called | Sends


@dataclass(frozen=True, slots=True)
class Scope:
    """The names of one class, those of its ancestors included, and the locals of one body.

    `constants` are those of C++ that the body's file can name: their values stand for them.
    """

    members: Mapping[str, Member]
    functions: Mapping[str, Function]
    bases: Mapping[str, str]
    types: frozenset[str] = frozenset()
    callable: frozenset[str] = frozenset()
    locals: Mapping[str, Expression] = field(default_factory=dict)
    constants: Mapping[str, tuple[Cpp, Node]] = field(default_factory=dict)

    def with_locals(self, found: Mapping[str, Expression]) -> Scope:
        """The same with more locals, which hide what has their names."""
        return replace(self, locals={**self.locals, **found})

    def without_constant(self, name: str) -> Scope:
        """What the value of a constant can name: all but itself."""
        others = {n: v for n, v in self.constants.items() if n != name}
        return replace(self, constants=others, locals={})

    def local(self, name: str) -> str:
        """The model's name of a local variable or parameter."""
        return uncarry_local(name, RESERVED | self.types | self.callable, self.callable)

    def declare(self, *names: str) -> Scope:
        """The same with these local variables."""
        return self.with_locals({n: Name(self.local(n)) for n in names})
