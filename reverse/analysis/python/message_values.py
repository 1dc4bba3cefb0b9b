"""Which values are messages that came to a node of Python, or parts of them: a provenance analysis.

No program put objects of its own classes there: a message, and each of its fields, is made of plain
values, and classes of the program answer for nothing that is asked of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import islice

from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.stores import CapturedVariable, Key, TemporaryVariable, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function, ParameterKind
from rebsync.reverse.ir.walk import Node, walk, walk_all
from rebsync.reverse.libraries import python
from rebsync.reverse.libraries.routines import Kind

# Functions of Python that give parts of what they get, and no others.
_PASSING = frozenset(
    f"builtins.{name}"
    for name in (
        *("enumerate", "zip", "reversed", "sorted", "list", "tuple", "set", "frozenset"),
        *("min", "max", "sum", "iter"),
    )
)
_AT = 2  # where the callback of a subscription stands


class MessageValues:
    """The values of one program."""

    def __init__(self, graph: CallGraph) -> None:
        self._graph = graph
        self._program = graph.program
        self._sources: dict[str, dict[Key, list[e.Expression | None]]] = {}

    def has(self, value: e.Expression, function: str) -> bool:
        """Whether a value is a message, a part of one, or plain."""
        return self._has(value, function, frozenset())

    def _has(self, value: e.Expression, function: str, seen: frozenset[Key]) -> bool:
        match value:
            case e.Literal() | e.Format():
                return True
            case e.Attribute(of, name):
                return name not in self._stored_from_outside and self._has(of, function, seen)
            case e.Index(of) | e.Convert(_, of) | e.Copy(of) | e.Unary(_, of):
                return self._has(of, function, seen)
            case e.Binary(_, left, right) | e.Conditional(_, left, right):
                return all(self._has(each, function, seen) for each in (left, right))
            case e.And(left, right) | e.Or(left, right):
                return all(self._has(each, function, seen) for each in (left, right))
            case e.Local() | e.Temporary():
                key = key_of(value, function)
                assert key is not None
                return key in seen or self._is_variable(key, function, seen | {key})
            case _:
                return False

    def _is_variable(self, key: Key, function: str, seen: frozenset[Key]) -> bool:
        around = self._program.function(function)
        if isinstance(key, CapturedVariable):
            parameters = [p for p in around.parameters if p.name == key.name]
            if key.name in around.captured or (parameters and key not in self._messages):
                return False
            if parameters and key not in self._of(around):
                return True
        sources = self._of(around).get(key, [])
        return bool(sources) and all(
            each is not None and self._has(each, function, seen) for each in sources
        )

    def _of(self, function: Function) -> dict[Key, list[e.Expression | None]]:
        """By each variable of a function what is stored in it, or what that is an element of."""
        if function.name not in self._sources:
            found: dict[Key, list[e.Expression | None]] = {}
            for node in walk(function):
                for target, source in _stored(node):
                    key = key_of(target, function.name)
                    if isinstance(key, CapturedVariable | TemporaryVariable):
                        found.setdefault(key, []).append(source)
            self._sources[function.name] = found
        return self._sources[function.name]

    @cached_property
    def _messages(self) -> frozenset[Key]:
        """The parameters of functions that subscriptions alone call."""
        handed: dict[str, int] = {}
        for name, node in walk_all(self._program):
            for callback in _callbacks(node):
                called = callback_functions(self._graph, callback, name)
                handed |= {f: handed.get(f, 0) + 1 for f in called}
        return frozenset(
            CapturedVariable(name, first)
            for name, times in handed.items()
            if self._named.get(_last(name), 0) == times
            for first in first_parameter(self._program.function(name))
        )

    @cached_property
    def _named(self) -> dict[str, int]:
        """How often the program names each function, by the last part of its name."""
        found: dict[str, int] = {}
        for _, node in walk_all(self._program):
            match node:
                case (
                    e.Attribute(_, called)
                    | s.MethodCallee(_, called)
                    | e.Global(_, called)
                    | e.FunctionReference(called)
                ):
                    found[_last(called)] = found.get(_last(called), 0) + 1
                case e.Closure(called) if "<" in _last(called):
                    found[_last(called)] = found.get(_last(called), 0) + 1
                case _:
                    pass
        return found

    @cached_property
    def _stored_from_outside(self) -> frozenset[str]:
        """The attributes that functions store in other objects than their own."""
        found = set[str]()
        for name in self._program.functions:
            function = self._program.function(name)
            for node in walk(function):
                for target, source in _stored(node):
                    match target:
                        case e.Attribute(of, attribute):
                            is_own = of == e.Local(function.receiver or "")
                            if not is_own and not isinstance(source, e.Literal | e.Binary):
                                found.add(attribute)
                        case _:
                            pass
        return frozenset(found)


def callback_functions(graph: CallGraph, callback: e.Expression, function: str) -> frozenset[str]:
    """The functions that a callback may be: a method of the own class, or one by its name."""
    around = graph.program.function(function)
    match callback:
        case e.Attribute(e.Local() as holder, name) if (
            owner := graph.class_of(holder, around)
        ) is not None:
            classes = (graph.program.classes.get(c) for c in graph.family(owner))
            found = (dict(c.methods).get(name) for c in classes if c is not None)
            return frozenset(f for f in found if f is not None)
        case e.Global(module, name):
            return frozenset({f"{module}:{name}"} & set(graph.program.functions))
        case e.Closure(name):
            return frozenset({name})
        case e.Temporary(number):
            match graph.stores.of(TemporaryVariable(function, number)):
                case [(_, e.Attribute() | e.Global() | e.Closure() as value)]:
                    return callback_functions(graph, value, function)
                case _:
                    return frozenset()
        case _:
            return frozenset()


def first_parameter(function: Function) -> Iterator[str]:
    """The parameter of a callback that takes the message."""
    return islice(own_parameters(function), 1)


def own_parameters(function: Function) -> Iterator[str]:
    """The parameters of a function that get what stands at a place, but for the object."""
    for parameter in (p for p in function.parameters if p.name != function.receiver):
        if parameter.kind in (ParameterKind.PLAIN, ParameterKind.BY_PLACE):
            yield parameter.name


def _last(name: str) -> str:
    return name.rpartition(":")[2].rpartition(".")[2]


def _callbacks(node: Node) -> Iterator[e.Expression]:
    """The callback of a subscription that a call asks for."""
    match node:
        case s.Call(_, s.LibraryCallee() | s.MethodCallee() as callee, arguments):
            if not _subscribes(callee):
                return
            by_place = [a.value for a in arguments if a.name is None and not a.stars]
            named = [a.value for a in arguments if a.name == "callback"]
            is_more = len(by_place) > _AT + 1 and isinstance(node.callee, s.LibraryCallee)
            if not is_more and not any(a.name == "callback_args" for a in arguments):
                yield from (*by_place[_AT : _AT + 1], *named)
        case _:
            pass


def _subscribes(callee: s.LibraryCallee | s.MethodCallee) -> bool:
    """Whether a function, or a method of a node, asks for a subscription."""
    if isinstance(callee, s.LibraryCallee):
        return callee.name in python.names_of(Kind.SUBSCRIPTION)
    routine = python.node_method(callee.name)
    return routine is not None and routine.kind is Kind.SUBSCRIPTION


def _stored(node: Node) -> Iterator[tuple[e.Expression, e.Expression | None]]:
    """What a node stores in, and the value or what that is a part of; None for any other."""
    match node:
        case s.Assign(target, value):
            yield target, value
        case s.Declare(target, _, value):
            yield target, value
        case s.CompoundAssign(target, operator, value):
            yield target, e.Binary(operator, target, value)
        case s.ForEach(target, iterable):
            yield target, iterable
        case s.Unpack(targets, value):
            yield from ((target, value) for target in targets)
        case s.Call(target, s.LibraryCallee(name), arguments) if target is not None:
            if name not in _PASSING or any(a.name is not None for a in arguments):
                yield target, None
            else:
                yield from ((target, a.value) for a in arguments)
        case _ if (target := getattr(node, "target", None)) is not None:
            if not isinstance(node, e.AddressOf):
                yield target, None
        case _:
            pass
