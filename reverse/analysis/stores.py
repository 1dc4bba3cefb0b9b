"""Which values are stored under each name in a program, wherever that is (flow-insensitive)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.analysis.locations import CapturedVariable, GlobalVariable, Member
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
class TemporaryVariable:
    """A temporary of a function."""

    function: str
    number: int


# Locals that nobody captures are `CapturedVariable` here as well.
Key: TypeAlias = GlobalVariable | CapturedVariable | Member | TemporaryVariable
Value: TypeAlias = e.Expression | AnyValue | ClassValue | ObjectValue | CallResult
Stored: TypeAlias = tuple[str, Value]
ANY_VALUE = AnyValue()


@dataclass(frozen=True, slots=True)
class Stores:
    """By each variable or attribute the values that are stored in it, with their functions.

    `changed` says what `+=` and the like compute, each of which is any value in `values`.
    """

    values: dict[Key, list[Stored]] = field(default_factory=dict)
    changed: dict[Key, list[Stored]] = field(default_factory=dict)

    def of(self, key: Key) -> list[Stored]:
        return self.values.get(key, [])

    def initial(self, key: Key) -> list[Stored]:
        """What is stored otherwise than by `+=` and the like."""
        found = list(self.of(key))
        for function, _ in self.changed.get(key, []):
            found.remove((function, ANY_VALUE))
        return found


def stores_of(program: Program) -> Stores:
    """All stores of a program, whose bodies are all lowered for this."""
    stores = Stores()
    for name in program.functions:
        function = program.function(name)
        for key, value in _stores(function):
            stores.values.setdefault(key, []).append((name, value))
        for node in walk(function):
            if isinstance(node, s.CompoundAssign):
                changed = key_of(node.target, name)
                value = e.Binary(node.operator, node.target, node.value, node.target.type)
                if changed is not None:
                    stores.changed.setdefault(changed, []).append((name, value))
    return stores


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
