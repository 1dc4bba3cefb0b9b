"""What values may be: which callables, classes, objects and containers a name may stand for.

By what is stored under each name anywhere in the program (flow-insensitive), as in the call graph.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.cpp_facts import CppFacts
from rebsync.reverse.analysis.fixpoint import Rounds
from rebsync.reverse.analysis.implicit_calls import implicit_calls
from rebsync.reverse.analysis.program_names import ProgramNames
from rebsync.reverse.analysis.python.enumeration_members import EnumerationMembers
from rebsync.reverse.analysis.stores import (
    AnyValue,
    CallResult,
    ClassValue,
    Key,
    Member,
    ObjectValue,
    Stored,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import ImplicitCall, Operator
from rebsync.reverse.ir.program import FunctionKind, Program
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language

_SUSPENDED = (FunctionKind.GENERATOR, FunctionKind.COROUTINE)


@dataclass(frozen=True, slots=True)
class FunctionOrigin:
    """A function of the program."""

    name: str


@dataclass(frozen=True, slots=True)
class ClassOrigin:
    """A class of the program, or (`of_object`) an object of it."""

    name: str
    of_object: bool = True


@dataclass(frozen=True, slots=True)
class LibraryOrigin:
    """What a library has under a full name, or (`of_object`) an object that it gave."""

    name: str
    of_object: bool = False


@dataclass(frozen=True, slots=True)
class PlainOrigin:
    """A number, a text that was computed, or nothing."""


@dataclass(frozen=True, slots=True)
class AnyOrigin:
    """A value of which nothing is known."""


Origin: TypeAlias = FunctionOrigin | ClassOrigin | LibraryOrigin | PlainOrigin | AnyOrigin
ANYTHING = frozenset[Origin]({AnyOrigin()})
PLAIN = frozenset[Origin]({PlainOrigin()})
_KINDS = {
    t.ContainerKind.SEQUENCE: "list",
    t.ContainerKind.TUPLE: "tuple",
    t.ContainerKind.QUEUE: "deque",
    t.ContainerKind.SET: "set",
    t.ContainerKind.MAPPING: "dict",
}


class Origins:
    """What the values of one program may be; `own` are the functions that people wrote."""

    def __init__(self, graph: CallGraph, table: LibraryOutcomes, own: Sequence[str]) -> None:
        self.graph = graph
        self.table = table
        self.own = own
        self._rounds = Rounds[Key, "frozenset[Origin]"](self._found, frozenset())
        self._run: dict[str, frozenset[str]] = {}

    @classmethod
    def of_program(cls, program: Program, table: LibraryOutcomes) -> Origins:
        """Those of a program of which all is people's own."""
        return cls(CallGraph(program), table, program.functions)

    def of(self, value: e.Expression, function: str) -> frozenset[Origin]:
        """What the value of an expression in a function may be."""
        match value:
            case e.Closure(name) | e.FunctionReference(name):
                return frozenset({FunctionOrigin(name)})
            case e.ClassReference(name):
                return frozenset({ClassOrigin(name, False)})
            case e.LibraryReference(name):
                return frozenset({LibraryOrigin(name)})
            case e.Build(t.Container(kind)) | e.BuildMapping(t.Container(kind)):
                return frozenset({LibraryOrigin(_KINDS[kind], True)})
            case e.Format() | e.Literal(str()):
                return frozenset({LibraryOrigin("str", True)})
            case e.Build() | e.Literal() | e.Unary():
                return PLAIN
            case e.Binary(Operator.ADD | Operator.MULTIPLY, left, right):
                return self.of(left, function) | self.of(right, function)
            case e.Binary(Operator.FLOOR_MODULO, left, right):
                return self._remainder(left, right, function)
            case e.Binary():
                return PLAIN
            case e.Conditional(_, left, right) | e.And(left, right) | e.Or(left, right):
                return self.of(left, function) | self.of(right, function)
            case e.Copy(operand) | e.Move(operand) | e.Convert(_, operand):
                return self.of(operand, function)
            case e.Dereference(operand) | e.AddressOf(operand):
                return self.of(operand, function)
            case e.Index(operand, e.Slice()):
                return self.of(operand, function)
            case e.Attribute(of, name) if found := self._enumerated(of, name, function):
                return found
            case e.Attribute(e.Local() | e.Captured() | e.Attribute() | e.Temporary() as of, name):
                return self._member(of, name, function)
        key = key_of(value, function)
        return ANYTHING if key is None else self._stored(key)

    def _remainder(
        self, left: e.Expression, right: e.Expression, function: str
    ) -> frozenset[Origin]:
        """The remainder of a number; of a text, which `%` formats, it is a text."""
        held = self.of(left, function)
        if held & ANYTHING and self.of(right, function) != PLAIN:
            return ANYTHING
        return (held & {LibraryOrigin("str", True)}) or PLAIN

    def _member(self, of: e.Expression, name: str, function: str) -> frozenset[Origin]:
        held = self.of(of, function)
        if held and all(isinstance(o, LibraryOrigin) and not o.of_object for o in held):
            return frozenset(
                LibraryOrigin(f"{o.name}.{name}") for o in held if isinstance(o, LibraryOrigin)
            )
        found = self._stored(Member(name))
        methods = {
            f for o in held if isinstance(o, ClassOrigin) for f in self.methods(o.name, name)
        }
        found = found.union(map(FunctionOrigin, methods))
        if self.table.language is Language.PYTHON and not self._is_own(of, held, function):
            found |= ANYTHING  # a message, or what else the program did not make, has its own
        return found or ANYTHING

    def _enumerated(self, of: e.Expression, name: str, function: str) -> frozenset[Origin]:
        """The object that a member of an enumeration is; nothing for any other attribute."""
        if name not in self.enumerations.names:
            return frozenset()
        held = (o for o in self.of(of, function) if isinstance(o, ClassOrigin) and not o.of_object)
        return frozenset(ClassOrigin(o.name) for o in held if name in self.enumerations.of(o.name))

    def _is_own(self, value: e.Expression, held: frozenset[Origin], function: str) -> bool:
        """Whether a value is an object that the program made: its attributes are told by names."""
        match value:
            case e.Local(name) if name == self.object_of.get(function):
                return True
            case e.Captured(around, name) if name == self.object_of.get(around):
                return True
            case _:
                return bool(held) and all(isinstance(o, ClassOrigin) for o in held)

    def _stored(self, key: Key) -> frozenset[Origin]:
        """What is stored under a name: what depends on nothing but itself may be anything."""
        found = self._rounds.of(key)
        return found if found or self._rounds.is_under_way else ANYTHING

    def _found(self, key: Key, before: frozenset[Origin]) -> frozenset[Origin]:
        stored = self.graph.stores.of(key)
        found = frozenset[Origin]().union(*map(self.of_stored, stored))
        return (found if stored else ANYTHING) | before

    def of_stored(self, stored: Stored) -> frozenset[Origin]:
        """What a stored value may be."""
        function, value = stored
        match value:
            case ClassValue(name):
                return frozenset({ClassOrigin(name, False)})
            case ObjectValue(name):
                return frozenset({ClassOrigin(name)})
            case CallResult(call):
                return self.result(call, function)
            case AnyValue():
                return ANYTHING
            case _:
                return self.of(value, function)

    def result(self, call: s.Call, function: str) -> frozenset[Origin]:
        """What a call gives."""
        match call.callee:
            case s.FunctionCallee(name):
                return self._returned(name)
            case s.LibraryCallee(name):
                return self._made(LibraryOrigin(name), call, function)
            case s.ValueCallee(value):
                held = self.of(value, function)
                results = (self._made(origin, call, function) for origin in held)
                return frozenset[Origin]().union(*results)
            case _:
                return ANYTHING

    def _made(self, origin: Origin, call: s.Call, function: str) -> frozenset[Origin]:
        match origin:
            case ClassOrigin(name, False):
                return frozenset({ClassOrigin(name)})
            case FunctionOrigin(name):
                return self._returned(name)
            case LibraryOrigin(name, is_object) if self.table.function(name).returns:
                plain = [a.value for a in call.arguments if a.name is None]
                if plain:
                    return self.of(plain[0], function)
                return ANYTHING if is_object else frozenset({LibraryOrigin(name, True)})
            case LibraryOrigin(name, False):
                outcome = self.table.function(name)
                if outcome.gives == "number":
                    return PLAIN
                return frozenset({LibraryOrigin(outcome.gives or name, True)})
            case _:
                return ANYTHING

    def _returned(self, name: str) -> frozenset[Origin]:
        body = self.graph.program.function(name)
        if body.kind in _SUSPENDED:
            return ANYTHING  # an iterator, or what is awaited
        values = [n.value for n in walk(body) if isinstance(n, s.Return)]
        found = (self.of(v, name) if v is not None else PLAIN for v in values)
        return frozenset[Origin]().union(*found) or PLAIN

    def own_classes(self, value: e.Expression, function: str) -> frozenset[str]:
        """The classes of the program that a value may be an object of, as far as is known."""
        type_ = getattr(value, "type", t.UNKNOWN)
        type_ = type_.to if isinstance(type_, t.Reference) else type_
        if isinstance(type_, t.Record):
            return frozenset({type_.name} & set(self.graph.program.classes))
        held = self.of(value, function)
        return frozenset(o.name for o in held if isinstance(o, ClassOrigin) and o.of_object)

    def may_have_method(self, value: e.Expression, name: str) -> bool:
        """Whether a class of the program has a method, and of a value no type is known in C++."""
        type_ = getattr(value, "type", t.UNKNOWN)
        is_variable = isinstance(value, e.Local | e.Temporary)
        return is_variable and type_ == t.UNKNOWN and bool(self.methods_of_any(name))

    def has_method(self, of: str, name: str) -> bool:
        """Whether a class has a method, or one of the program's that it extends."""
        classes = (self.graph.program.classes.get(c) for c in (of, *self.graph.bases(of)))
        return any(n == name for c in classes if c is not None for n, _ in c.methods)

    # --- classes ---------------------------------------------------------------------------------

    @cached_property
    def object_of(self) -> dict[str, str]:
        """For each method of Python the name of the parameter that is its object."""
        program = self.graph.program
        classes = program.classes.values()
        methods = [f for c in classes for _, f in c.methods if f in program]
        methods += [f for c in classes for p in c.properties for f in p.functions if f in program]
        given = ((f, program.function(f).parameters) for f in methods)
        return {f: parameters[0].name for f, parameters in given if parameters}

    def methods(self, of: str, name: str) -> frozenset[str]:
        """The functions that a method of an object may be, by the class it is declared of."""
        classes = (self.graph.program.classes.get(c) for c in self.graph.family(of))
        return frozenset(f for c in classes if c is not None for n, f in c.methods if n == name)

    def methods_of_any(self, name: str) -> frozenset[str]:
        """The methods of a name that any class has."""
        classes = self.graph.program.classes.values()
        return frozenset(f for c in classes for n, f in c.methods if n == name)

    @cached_property
    def operators(self) -> frozenset[str]:
        """What libraries may call of the objects that they get: to compare them, and the like."""
        classes = self.graph.program.classes.values()
        asked = {o for c in classes for o, _ in c.operators}
        return self.graph.implicit(asked - {ImplicitCall.CONSTRUCT, ImplicitCall.CALL})

    @cached_property
    def of_cpp(self) -> CppFacts:
        """What the program says as a whole, if it is of C++."""
        return CppFacts(self.graph.program)

    @cached_property
    def names(self) -> ProgramNames:
        """Which functions name which attributes."""
        return ProgramNames(self.graph.program)

    @cached_property
    def enumerations(self) -> EnumerationMembers:
        """The members of the program's enumerations."""
        return EnumerationMembers(self.graph)

    # --- calls -----------------------------------------------------------------------------------

    def runs(self, body: s.Body, function: str) -> Iterator[tuple[str, s.Body]]:
        """A body, and those of all functions of the program that it may run."""
        waiting, seen = [(function, body)], set[str]()
        while waiting:
            function, inner = waiting.pop()
            yield function, inner
            around = replace(self.graph.program.function(function), body=inner)
            found = implicit_calls(self.graph, around)
            implicit = found.functions | (self.operators if found.has_library else frozenset())
            implicit -= seen
            waiting += ((n, self.graph.program.function(n).body) for n in implicit)
            seen |= implicit
            for node in walk(inner):
                reached = self.reached(node, function)
                waiting += ((n, self.graph.program.function(n).body) for n in reached - seen)
                seen |= reached

    def all_run(self, functions: Iterable[str]) -> frozenset[str]:
        """Some functions, and all of the program that they may run."""
        found = set(functions)
        waiting = list(found)
        while waiting:
            new = self._run_itself(waiting.pop()) - found
            found |= new
            waiting += new
        return frozenset(found)

    def _run_itself(self, name: str) -> frozenset[str]:
        """The functions that one runs, without what these run."""
        if name not in self._run:
            function = self.graph.program.function(name)
            found = implicit_calls(self.graph, function)
            implicit = found.functions | (self.operators if found.has_library else frozenset())
            self._run[name] = implicit.union(*(self.reached(n, name) for n in walk(function.body)))
        return self._run[name]

    def reached(self, node: Node, function: str) -> frozenset[str]:
        """The functions of the program that a node may run; of unknown ones none is meant."""
        match node:
            case s.Construct(_, _, _, str() as name):
                return frozenset({name})
            case s.Construct(_, name):
                return self.graph.construction(name).functions
            case s.Call(_, callee, arguments):
                around = self.graph.program.function(function)
                values = [a.value for a in arguments]
                if isinstance(callee, s.ValueCallee):
                    values.append(callee.value)
                handed = (self._functions(value, function) for value in values)
                return self.graph.callee(callee, around).functions.union(*handed)
            case _:
                return frozenset()

    def _functions(self, value: e.Expression, function: str) -> frozenset[str]:
        held = self.of(value, function)
        return frozenset(o.name for o in held if isinstance(o, FunctionOrigin))
