"""The call graph: which functions a call may reach, by class hierarchy and stored function values.

Class hierarchy analysis (Dean, Grove, Chambers 1995) where the receiver's class is known, else by
name; function values by what is stored under a name anywhere in the program. What it does not know
is `unknown`: any function may be called then.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

from rebsync.records import dataclass
from rebsync.reverse.analysis.stores import (
    AnyValue,
    CallResult,
    CapturedVariable,
    ClassValue,
    GlobalVariable,
    Key,
    Member,
    ObjectValue,
    Stores,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import ImplicitCall, Operator
from rebsync.reverse.ir.program import Class, Function, FunctionKind, Program


@dataclass(frozen=True, slots=True)
class Targets:
    """What a call may reach: functions of the program, those of libraries, or `unknown` ones."""

    functions: frozenset[str] = frozenset()
    libraries: frozenset[str] = frozenset()
    unknown: bool = False

    def join(self, other: Targets) -> Targets:
        """The targets of either."""
        return Targets(
            self.functions | other.functions,
            self.libraries | other.libraries,
            self.unknown or other.unknown,
        )


NO_TARGETS = Targets()
UNKNOWN_TARGETS = Targets(unknown=True)


def join_all(targets: Iterable[Targets]) -> Targets:
    """The targets of all."""
    found = NO_TARGETS
    for each in targets:
        found = found.join(each)
    return found


class CallGraph:
    """The call graph of one program."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.stores = Stores(program)
        self._methods: dict[str, list[str]] = {}
        for class_ in program.classes.values():
            for name, function in class_.methods:
                self._methods.setdefault(name, []).append(function)

    # --- classes ---------------------------------------------------------------------------------

    @cached_property
    def subclasses(self) -> dict[str, set[str]]:
        """By each class those that extend it, itself included."""
        found: dict[str, set[str]] = {name: {name} for name in self.program.classes}
        for name in self.program.classes:
            for base in self.bases(name):
                found.setdefault(base, {base}).add(name)
        return found

    def bases(self, name: str) -> list[str]:
        """The classes that a class extends, near ones first; libraries' by their names too."""
        found: list[str] = []
        waiting = [name]
        while waiting:
            class_ = self.program.classes.get(waiting.pop(0))
            for base in class_.bases if class_ is not None else ():
                if base is not None and base not in found and base != name:
                    found.append(base)
                    waiting.append(base)
        return found

    def family(self, name: str) -> set[str]:
        """A class, all that it extends, all that extend it, and all that these extend."""
        found = {name, *self.bases(name)}
        for derived in self.subclasses.get(name, ()):
            found |= {derived, *self.bases(derived)}
        return found

    def implicit(self, calls: Iterable[Operator | ImplicitCall]) -> frozenset[str]:
        """The functions that answer operators or implicit calls in any class."""
        wanted = frozenset(calls)
        names = {
            method
            for class_ in self.program.classes.values()
            for call, method in class_.operators
            if call in wanted
        }
        return frozenset(f for name in names for f in self._methods.get(name, ()))

    def accessors(self, name: str, part: str) -> frozenset[str]:
        """The getters, setters or deleters of properties of a name in any class."""
        found = (
            getattr(each, part)
            for class_ in self.program.classes.values()
            for each in class_.properties
            if each.name == name
        )
        return frozenset(f for f in found if f is not None)

    @cached_property
    def suspended(self) -> frozenset[str]:
        """The functions whose bodies run when somebody asks their results: generators."""
        kinds = (FunctionKind.GENERATOR, FunctionKind.COROUTINE)
        names = self.program.functions
        return frozenset(n for n in names if self.program.function(n).kind in kinds)

    # --- calls -----------------------------------------------------------------------------------

    def targets(self, call: s.Call, function: Function) -> Targets:
        """What a call may reach; a call of a class reaches its constructors."""
        return self.callee(call.callee, function)

    def callee(self, callee: s.Callee, function: Function) -> Targets:
        """What may be called."""
        match callee:
            case s.FunctionCallee(name):
                return Targets(frozenset({name}))
            case s.LibraryCallee(name):
                return Targets(libraries=frozenset({name}))
            case s.ValueCallee(value):
                return self.value(value, function)
            case s.MethodCallee(receiver, name, declared):
                known = declared or self.class_of(receiver, function)
                return self._method(known, name, set())

    def _method(self, known: str | None, name: str, seen: set[Key]) -> Targets:
        """What is called under the name of an attribute of an object of a class, or of any."""
        stored = self.member(name, seen)
        if known is None:
            return stored.join(Targets(libraries=frozenset({f".{name}"})))
        family = self.family(known)
        classes = [self.program.classes[c] for c in family if c in self.program.classes]
        found = frozenset(f for c in classes for n, f in c.methods if n == name)
        is_plain = all(c.complete for c in classes) and not self._is_replaced(name)
        if found and is_plain and self._is_found(known, name):
            return Targets(found)
        return stored.join(Targets(found, frozenset({f".{name}"})))

    def class_of(self, receiver: e.Expression, function: Function) -> str | None:
        """The class of the object that a method is called on, if nothing else is assigned to it."""
        if isinstance(receiver, e.Captured):
            function = self.program.function(receiver.function)
        elif not isinstance(receiver, e.Local):
            return None
        if function.owner is None or receiver.name != function.receiver:
            return None
        stored = self.stores.of(CapturedVariable(function.name, receiver.name))
        return function.owner if len(stored) == 1 else None

    def _is_found(self, name: str, method: str) -> bool:
        """Whether a class or one that it extends has a method."""
        every = [self.program.classes.get(c) for c in (name, *self.bases(name))]
        return any(method in dict(c.methods) for c in every if c is not None)

    def _is_replaced(self, name: str) -> bool:
        """Whether something is stored under the name of a method but its definition."""
        values = self.stores.of(Member(name))
        methods = set(self._methods.get(name, ()))
        return any(not (isinstance(v, e.Closure) and v.function in methods) for _, v in values)

    def member(self, name: str, seen: set[Key]) -> Targets:
        """What is called under the name of an attribute of any object."""
        found = Targets(frozenset(self._methods.get(name, ())))
        getters = self.accessors(name, "getter")
        if getters or self.implicit((ImplicitCall.GET_ATTRIBUTE, ImplicitCall.DESCRIBE)):
            found = found.join(UNKNOWN_TARGETS)
        decorated = {f for f in found.functions if not self._is_plain(f)}
        if decorated:
            found = found.join(UNKNOWN_TARGETS)
        return found.join(self._stored(Member(name), seen))

    def _is_plain(self, function: str) -> bool:
        owner = self.program.function(function).owner
        class_: Class | None = self.program.classes.get(owner or "")
        return class_ is None or class_.complete

    def value(
        self, value: e.Expression, function: Function, seen: set[Key] | None = None
    ) -> Targets:
        """What is called when a value is called."""
        seen = set() if seen is None else seen
        match value:
            case e.Closure(name) | e.FunctionReference(name):
                return Targets(frozenset({name}))
            case e.LibraryReference(name):
                return Targets(libraries=frozenset({name}))
            case e.ClassReference(name):
                return self.construction(name)
            case e.Conditional(_, first, second) | e.And(first, second) | e.Or(first, second):
                parts = (first, second)
                return join_all(self.value(p, function, seen) for p in parts)
            case e.Attribute(e.ModuleReference(module), name):
                return self._stored(GlobalVariable(module, name), seen)
            case e.Attribute(holder, name):
                return self._method(self.class_of(holder, function), name, seen)
            case e.Local() | e.Temporary() | e.Captured() | e.Global():
                key = key_of(value, function.name)
                assert key is not None
                found = self._stored(key, seen)
                return found if found != NO_TARGETS or key in seen else UNKNOWN_TARGETS
            case e.Literal() | e.Format() | e.Build() | e.BuildMapping():
                return NO_TARGETS
            case _:
                return UNKNOWN_TARGETS

    def _stored(self, key: Key, seen: set[Key]) -> Targets:
        """What is called when that is called which is stored under a name."""
        if key in seen:
            return NO_TARGETS
        seen.add(key)
        found = NO_TARGETS
        for name, value in self.stores.of(key):
            match value:
                case AnyValue() | ObjectValue() | CallResult():
                    found = found.join(UNKNOWN_TARGETS)
                case ClassValue(class_name):
                    found = found.join(self.construction(class_name))
                case _:
                    found = found.join(self.value(value, self.program.function(name), seen))
        return found

    def construction(self, name: str) -> Targets:
        """What runs when an object of a class of the program is made."""
        class_ = self.program.classes.get(name)
        if class_ is None or not class_.complete:
            return UNKNOWN_TARGETS
        line = [name, *self.bases(name)]
        classes = [self.program.classes[c] for c in line if c in self.program.classes]
        if not all(c.complete for c in classes):
            return UNKNOWN_TARGETS
        makers = {
            method
            for c in classes
            for call, method in c.operators
            if call is ImplicitCall.CONSTRUCT
        }
        functions = frozenset(f for c in classes for n, f in c.methods if n in makers)
        libraries = frozenset(c for c in line if c not in self.program.classes)
        return Targets(functions, libraries)
