"""What names in the bodies of a package's Python stand for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field as with_default
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.intervals import INT32, INTEGERS, Interval, unsigned
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.bodies.scope import Target
from rebsync.reverse.build.message_types import Fields
from rebsync.reverse.findings import Unread
from rebsync.reverse.libraries.routines import Library
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.python.expressions.values import REAL, STRING, TRUTH, WHOLE, Kind, Value
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import Py
from rebsync.source import Span

# A variable: the class, module or function that it is in, and its name, with that of a field.
Key: TypeAlias = tuple[str, int, str]


class Pending(Unread):
    """Something stands on a variable of which nothing is known yet."""


# --- meanings -----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Var:
    """A variable that holds a value of the model: `name` is its own there."""

    key: Key
    name: str
    is_state: bool


@dataclass(frozen=True, slots=True)
class Message:
    """A message in a variable: each of its fields is a variable; or that of a server."""

    key: Key
    name: str
    type: str
    is_state: bool
    server: str = ""


@dataclass(frozen=True, slots=True)
class Own:
    """The object whose class is read."""


@dataclass(frozen=True, slots=True)
class Nobody:
    """What the model does not have."""


Meaning: TypeAlias = Var | Message | Own | Nobody | Value


@dataclass(frozen=True, slots=True)
class PyTarget:
    """A receiver: the unit and server that get a message, under the name that the sender has."""

    unit: str
    target: Target
    types: Mapping[str, m.Type]


@dataclass(frozen=True, eq=False, slots=True)
class PyUnit:
    """What of Python becomes a reactive class: a class with those above it, or a module.

    `lineage` is empty for a module; `calls` are the numbers of its facts by the ids of their calls.
    `library` is the client library that it uses, `version` that of the language, 0 where it may be
    2 or 3. What was found of functions, by the
    ids of their nodes: whether they are `quiet`, also from how deep, and names to be `kept`.
    """

    unit: Unit
    lineage: tuple[Scope, ...]
    module: Scope
    node: str
    calls: Mapping[tuple[str, int], int]
    version: int
    library: Library
    quiet: dict[tuple[int, int], bool] = with_default(default_factory=dict)
    kept: dict[int, frozenset[str]] = with_default(default_factory=dict)

    @property
    def name(self) -> str:
        return self.unit.name


@dataclass(eq=False, slots=True)
class Frame:
    """One run of a function: what its names stand for while its body is read.

    `assigned` are the locals that have a value for sure; `hoisted` those that are declared before
    all else; `depth` counts the statements around; `kept` says that its locals are state. `outer`
    is the run that it is called in, where that is read in its place.
    """

    scope: Scope
    names: dict[str, str] = with_default(default_factory=dict)
    bound: dict[str, Meaning] = with_default(default_factory=dict)
    assigned: set[str] = with_default(default_factory=set)
    declared: set[str] = with_default(default_factory=set)
    hoisted: dict[str, m.Type] = with_default(default_factory=dict)
    depth: int = 0
    kept: frozenset[str] = frozenset()
    is_start: bool = False
    server: str = ""
    outer: Frame | None = None

    @property
    def py(self) -> Py:
        return self.scope.py

    def of_scope(self, number: int) -> Frame | None:
        """The run of the function with a node of this id, of those that are under way."""
        at: Frame | None = self
        while at is not None and at.scope.node.id != number:
            at = at.outer
        return at

    def owner_of(self, key: Key) -> Frame | None:
        """The run whose local a variable is; None for one of none of those under way."""
        return self.of_scope(key[1]) if key[0] == "local" else None

    def span(self, node: Node) -> Span:
        return self.scope.py.span(node)


def unknown(frame: Frame, node: Node, what: str) -> Unknown:
    """The model has no such value."""
    return Unknown(frame.span(node), f"the model cannot know {what}", "")


def field_kind(type_: m.Type) -> Kind:
    """What a field of a message is in Python."""
    if type_.name in (TRUTH, STRING):
        return type_.name
    return REAL if type_.name in ("float", "double") else WHOLE


_UNSIGNED = (8, 16, 32, 64)


def bounds(fields: Fields, widths: Mapping[str, int], path: str) -> Interval:
    """What a whole number in a field of a message can be, as far as an `int` holds it."""
    bits = widths.get(path)
    if bits in _UNSIGNED:
        return unsigned(min(bits, 31))
    type_ = fields.get(path)
    return INTEGERS.get(type_.name, INT32) if type_ is not None else INT32
