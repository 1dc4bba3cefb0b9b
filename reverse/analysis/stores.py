"""Which values are stored under each name in a program, wherever that is (flow-insensitive)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function, Program
from rebsync.reverse.ir.walk import walk


@dataclass(frozen=True, slots=True)
class AnyValue:
    """A value of which nothing is known."""


@dataclass(frozen=True, slots=True)
class ClassValue:
    """A class of the program, by its name."""

    name: str


@dataclass(frozen=True, slots=True)
class ObjectValue:
    """A new object of a class of the program."""

    class_name: str


@dataclass(frozen=True, slots=True)
class CallResult:
    """What a call gives."""

    call: s.Call


@dataclass(frozen=True, slots=True)
class ElementOf:
    """An element of what a loop goes through."""

    container: e.Expression


@dataclass(frozen=True, slots=True)
class PartOf:
    """The part at a place of a sequence that is unpacked."""

    sequence: e.Expression
    at: int


@dataclass(frozen=True, slots=True)
class GlobalVariable:
    """A variable of a module."""

    module: str
    name: str


@dataclass(frozen=True, slots=True)
class CapturedVariable:
    """A local variable of all calls of a function, which functions within it may share."""

    function: str
    name: str


@dataclass(frozen=True, slots=True)
class Member:
    """An attribute of any object, class or module: told apart by names, not by objects."""

    name: str


@dataclass(frozen=True, slots=True)
class TemporaryVariable:
    """A temporary of a function."""

    function: str
    number: int


Key: TypeAlias = GlobalVariable | CapturedVariable | Member | TemporaryVariable
Drawn: TypeAlias = ElementOf | PartOf
Value: TypeAlias = e.Expression | AnyValue | ClassValue | ObjectValue | CallResult
Stored: TypeAlias = tuple[str, Value]
Source: TypeAlias = tuple[str, Value | Drawn]
ANY_VALUE = AnyValue()


class Stores:
    """By each variable or attribute the values that are stored in it, with their functions.

    Bodies are lowered when something is asked that they may store in: for a local that of its
    function, with all within it; for an attribute or a variable of a module those of the program.
    """

    def __init__(self, program: Program) -> None:
        self._program = program
        self._values: dict[Key, list[Stored]] = {}
        self._changed: dict[Key, list[Stored]] = {}
        self._drawn: dict[Key, list[tuple[str, Drawn]]] = {}
        self._seen: set[str] = set()
        self._is_whole = False

    def of(self, key: Key) -> list[Stored]:
        """All that is ever stored under a name."""
        self._see_all(key)
        return self._values.get(key, [])

    def changed(self, key: Key) -> list[Stored]:
        """What `+=` and the like compute; in `of` each of these is any value."""
        self._see_all(key)
        return self._changed.get(key, [])

    def initial(self, key: Key) -> list[Stored]:
        """What is stored otherwise than by `+=` and the like."""
        found = list(self.of(key))
        for function, _ in self.changed(key):
            found.remove((function, ANY_VALUE))
        return found

    def sources(self, key: Key) -> list[Source]:
        """All that is stored under a name, with what `+=`, loops and unpacking store there.

        In `of` each of these is any value.
        """
        found, drawn = self.initial(key), self._drawn.get(key, [])
        for function, _ in drawn:
            found.remove((function, ANY_VALUE))
        return [*found, *self.changed(key), *drawn]

    def everything(self) -> Iterator[Stored]:
        """All that is stored anywhere."""
        self._see_whole()
        for found in self._values.values():
            yield from found

    @cached_property
    def absent_by_default(self) -> Mapping[str, frozenset[str]]:
        """By each function the parameters that are None where no argument is for them."""
        self._see_whole()
        bodies = (self._program.function(name) for name in self._seen)
        closures = (n for body in bodies for n in walk(body) if isinstance(n, e.Closure))
        return {
            c.function: frozenset(name for name, value in c.defaults if is_none(value))
            for c in closures
        }

    def _see_all(self, key: Key) -> None:
        """Reads the bodies that may store under a name."""
        match key:
            case CapturedVariable(function) | TemporaryVariable(function):
                waiting = [function]
                while waiting and not self._is_whole:
                    waiting += self._see(waiting.pop())
            case _:
                self._see_whole()

    def _see_whole(self) -> None:
        for name in () if self._is_whole else self._program.functions:
            self._see(name)
        self._is_whole = True

    def _see(self, name: str) -> list[str]:
        """Reads one body; gives the functions that are defined within it."""
        if name in self._seen or name not in self._program:
            return []
        self._seen.add(name)
        function, inner = self._program.function(name), list[str]()
        for key, value in _stores(function):
            self._values.setdefault(key, []).append((name, value))
        for node in walk(function):
            match node:
                case s.CompoundAssign(target, operator, value):
                    changed = key_of(target, name)
                    computed = e.Binary(operator, target, value, target.type)
                    if changed is not None:
                        self._changed.setdefault(changed, []).append((name, computed))
                case s.ForEach(target, iterable):
                    self._draw(target, name, ElementOf(iterable))
                case s.Unpack(targets, value, rest):
                    for at, target in enumerate(targets):
                        if rest is None or at < rest:
                            self._draw(target, name, PartOf(value, at))
                case e.Closure(function=within) | s.DefineClass(_, within):
                    inner.append(within)
                case _:
                    pass
        return inner

    def _draw(self, target: e.Expression, function: str, value: Drawn) -> None:
        key = key_of(target, function)
        if key is not None:
            self._drawn.setdefault(key, []).append((function, value))


def key_of(target: e.Expression, function: str) -> Key | None:
    """The name that a value is stored under, seen from a function."""
    match target:
        case e.Local(name):
            return CapturedVariable(function, name)
        case e.Temporary(number):
            return TemporaryVariable(function, number)
        case e.Captured(owner, name):
            return CapturedVariable(owner, name)
        case e.Global(module, name):
            return GlobalVariable(module, name)
        case e.Attribute(e.ModuleReference(module), name):
            return GlobalVariable(module, name)
        case e.Attribute(_, name):
            return Member(name)
        case _:
            return None


def is_none(value: object) -> bool:
    """Whether a value is null or None as the source says it."""
    return isinstance(value, e.Literal) and value.value is None


def _stores(function: Function) -> Iterator[tuple[Key, Value]]:
    for parameter in function.parameters:
        yield CapturedVariable(function.name, parameter.name), ANY_VALUE
    for node in walk(function):
        for target, value in _stored(node):
            key = key_of(target, function.name)
            if key is not None:
                yield key, value
                if isinstance(key, GlobalVariable) and isinstance(target, e.Attribute):
                    yield Member(target.name), value


def _stored(node: object) -> Iterator[tuple[e.Expression, Value]]:
    """What one node stores, and where."""
    match node:
        case s.Assign(target, value):
            yield target, value
        case e.AddressOf(target):  # through which anything may be stored there
            yield target, ANY_VALUE
        case e.BuildRecord(_, fields):
            for name, value in fields:
                yield e.Attribute(node, name), value
        case s.Declare(target, _, value) if value is not None:
            yield target, value
        case s.CompoundAssign(target):
            yield target, ANY_VALUE
        case s.Unpack(targets):
            for target in targets:
                yield target, ANY_VALUE
        case s.ForEach(target) | s.Yield(target) | s.Await(target) | s.Handler(_, _, target):
            if target is not None:
                yield target, ANY_VALUE
        case s.Call(target) if target is not None:
            yield target, CallResult(node)
        case s.Construct(target, class_name) if target is not None:
            yield target, ObjectValue(class_name)
        case s.Unsupported(_, _, _, target) | s.With(_, target):
            if target is not None:
                yield target, ANY_VALUE
            if isinstance(node, s.Unsupported):
                for written in node.writes:
                    yield written, ANY_VALUE
        case s.DefineClass(target, name):
            yield target, ClassValue(name)
        case s.Import(target, module, name, is_program) if target is not None:
            yield target, _imported(module, name, is_program)
        case _:
            pass


def _imported(module: str, name: str | None, is_program: bool) -> e.Expression:
    if not is_program:
        return e.LibraryReference(module if name is None else f"{module}.{name}")
    return e.ModuleReference(module) if name is None else e.Global(module, name)
