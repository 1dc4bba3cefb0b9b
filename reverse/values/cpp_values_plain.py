"""What an expression of C++ may be worth while nothing runs, and how such values are combined.

Besides the values of a graph there are some that lead to them: handles, spans of time, objects.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import FromParameter, OneOf, Place, Resolved, Unresolved
from rebsync.reverse.policies import USUAL, Policies
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp

WHOLE = frozenset(
    {
        *("int", "unsigned", "long", "short", "char", "size_t", "uint8_t", "int8_t", "uint16_t"),
        *("int16_t", "uint32_t", "int32_t", "uint64_t", "int64_t", "unsignedint", "longlong"),
        *("unsignedlong", "unsignedchar", "longint", "unsignedlongint"),
    }
)
FLOATING = frozenset({"double", "float"})
NUMBERS = WHOLE | FLOATING | {"bool"}

# Stands for the name of the node in a text; `~` is what a private name begins with.
OWN_NAME = "\ue000"

# More ways than these to go are not followed one by one.
MOST = 64
TOO_MANY = "one of too many values"
# Values of more parts are not followed: on public code the largest have 40.
_MOST_PARTS = 128
_LONGEST_TEXT = 1 << 16
_LARGEST_NUMBER = 1 << 128


@dataclass(frozen=True, eq=False)
class Use:
    """A place that calls a function, or hands it on with arguments (`handed`)."""

    cpp: Cpp
    node: Node
    arguments: tuple[Node, ...]
    around: CppFunction | None
    handed: bool = False


@dataclass(frozen=True, eq=False)
class Frame:
    """A function on the way to a value, and the call that led into it.

    Without `call` its parameters are open, and asked of all callers; if it is `outside`, no file
    calls it.
    """

    cpp: Cpp
    function: CppFunction | None = None
    call: Use | None = None
    caller: Frame | None = None
    outside: bool = False

    @property
    def root(self) -> Frame:
        """The frame at the start of the way."""
        return self if self.caller is None else self.caller.root

    @property
    def depth(self) -> int:
        """How many calls led here."""
        return 0 if self.caller is None else self.caller.depth + 1


class OpenCallers(Exception):
    """A parameter was asked for whose callers are still open."""

    def __init__(self, frame: Frame) -> None:
        super().__init__()
        self.frame = frame


@dataclass(frozen=True, slots=True)
class Nothing:
    """What a variable holds that was given no value."""


@dataclass(frozen=True, slots=True)
class Handle:
    """A node handle of a namespace."""

    namespace: Resolved


@dataclass(frozen=True, slots=True)
class Length:
    """A span of time in seconds; `each` says that it was given as a frequency."""

    seconds: Resolved
    each: bool = False


@dataclass(frozen=True, slots=True)
class Quality:
    """A quality of service: how many messages wait at most, and whether the last is kept.

    `policies` are those that must fit the other end.
    """

    depth: Resolved
    latched: Resolved = False
    policies: Policies = USUAL


@dataclass(frozen=True, slots=True)
class Found:
    """The full name of a parameter that a search upwards found."""

    name: Resolved


@dataclass(frozen=True, eq=False)
class Made:
    """An object of a class, with the arguments it is made of."""

    type: str
    use: Use
    frame: Frame


@dataclass(frozen=True, eq=False)
class Function:
    """A function, lambda or functor as a value."""

    node: Node
    frame: Frame


@dataclass(frozen=True, slots=True)
class Choice:
    """One of several values."""

    values: tuple[Value, ...]


Value: TypeAlias = (
    "Resolved | Nothing | Handle | Length | Quality | Found | Made | Function | Choice"
)


_HASHED = (bool, int, float, str)
# Values that have no parts.
_SMALL = frozenset({bool, float, Nothing, Unresolved, Function, Made})


def ways(value: Value) -> Iterator[Value]:
    """The values that it may be."""
    match value:
        case Choice(values):
            for inner in values:
                yield from ways(inner)
        case OneOf(resolved):
            yield from resolved
        case _:
            yield value


def choice(values: Iterable[Value]) -> Value:
    """One of these values; of several that are equal, one. Nothing gives way to anything."""
    given = list(values)
    if len(given) == 1:
        return given[0]
    some: list[Value] = []
    seen: set[tuple[type, object]] = set()
    for value in given:
        for way in ways(value):
            if isinstance(way, _HASHED):
                if (type(way), way) not in seen:
                    seen.add((type(way), way))
                    some.append(way)
            elif not isinstance(way, Nothing) and not any(same(way, f) for f in some):
                some.append(way)
    match some:
        case []:
            return Nothing()
        case [only]:
            return only
        case _:
            return Choice(tuple(some))


def same(left: Value, right: Value) -> bool:
    """Whether two values are the same: `1` and `True` are not."""
    return type(left) is type(right) and left == right


def each(do: Callable[[Value], Value], value: Value) -> Value:
    """What is made of each value that it may be."""
    if not isinstance(value, (Choice, OneOf)):
        return do(value)
    return choice(do(way) for way in ways(value))


def pairs(do: Callable[[Value, Value], Value], left: Value, right: Value) -> Value:
    """What is made of each pair of values that they may be."""
    if not isinstance(left, (Choice, OneOf)) and not isinstance(right, (Choice, OneOf)):
        return do(left, right)
    return choice(do(a, b) for a in ways(left) for b in ways(right))


def is_large(value: Value) -> bool:
    """Whether a value has too many parts to be followed.

    Values share their parts, so that each variable of a row can be twice as large as the one
    before, at no cost but to those who look at the parts.
    """
    if type(value) in _SMALL:
        return False
    waiting: list[Value | None] = [value]
    for _ in range(_MOST_PARTS):
        if not waiting:
            return False
        match waiting.pop():
            case Choice(values):
                waiting += values
            case OneOf(some):
                waiting += some
            case FromParameter(name, default):
                waiting += (name, default)
            case Length(part) | Quality(part) | Handle(part) | Found(part):
                waiting.append(part)
            case str() as text:
                if len(text) > _LONGEST_TEXT:
                    return True
            case int() as number:
                if abs(number) > _LARGEST_NUMBER:
                    return True
            case tuple() as listed:
                waiting += [v for v in listed if isinstance(v, tuple)]
            case _:
                pass
    return bool(waiting)


def at(cpp: Cpp, node: Node) -> Place:
    """The place of a node."""
    return Place(cpp.source, cpp.span(node))
