"""What functions of Python get for their parameters: by the calls that reach them, and messages.

Calls of which it is not known what they reach give nothing here: more may come.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cached_property

from rebsync.reverse.analysis.origins import (
    ClassOrigin,
    FunctionOrigin,
    LibraryOrigin,
    Origin,
    Origins,
)
from rebsync.reverse.analysis.python.call_binding import KEEPING, bound
from rebsync.reverse.analysis.python.class_decorators import ClassDecorators
from rebsync.reverse.analysis.python.message_values import (
    callback_functions,
    first_parameter,
    own_parameters,
)
from rebsync.reverse.analysis.stores import (
    ANY_VALUE,
    CallResult,
    Drawn,
    ElementOf,
    Member,
    Source,
    Value,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function
from rebsync.reverse.ir.walk import walk, walk_all
from rebsync.reverse.libraries import python
from rebsync.reverse.libraries.callbacks import CALLBACKS
from rebsync.reverse.libraries.routines import Access, Kind, Routine

_FOR_EACH = frozenset({"builtins.map", "builtins.filter"})
# Functions of Python that call what they get with elements alone, or never.
_KNOWN_USERS = KEEPING | _FOR_EACH | {"builtins.super", "builtins.isinstance", "functools.reduce"}
_MESSAGE = re.compile(r"(\w+)\.(?:msg|srv)(?:\._\w+)?\.(\w+?)(?:\.?(Request|Response))?")
_PARTS = ("Request", "Response")  # what the callback of a service gets, in this order


def message_name(name: str) -> str | None:
    """`std_msgs/Int32` for the class `std_msgs.msg.Int32`; None for any other name.

    The parts of services are messages too: `std_srvs/Trigger_Response`.
    """
    found = _MESSAGE.fullmatch(name)
    if found is None:
        return None
    plain = f"{found[1]}/{found[2]}"
    return f"{plain}_{found[3]}" if found[3] else plain


class ArgumentTypes:
    """The arguments and messages of one program."""

    def __init__(self, origins: Origins, decorators: ClassDecorators) -> None:
        self._origins = origins
        self._decorators = decorators
        self._graph = origins.graph
        self._program = origins.graph.program

    def arguments(self, function: str, parameter: str) -> list[Source]:
        """What calls give for a parameter, with the functions that these stand in; defaults too."""
        return self._given.get((function, parameter), [])

    def fields(self, name: str) -> list[Source]:
        """What calls of data classes give for a field."""
        return self._built.get(name, [])

    @cached_property
    def _built(self) -> dict[str, list[Source]]:
        found: dict[str, list[Source]] = {}
        for name, node in walk_all(self._program):
            match node:
                case s.Call(_, s.ValueCallee(value)):
                    for origin in self._origins.of(value, name):
                        if isinstance(origin, ClassOrigin) and not origin.of_object:
                            for field, given in self._for_fields(node, origin.name):
                                found.setdefault(field, []).append((name, given))
                case _:
                    pass
        return found

    def _for_fields(self, call: s.Call, name: str) -> Iterator[tuple[str, Value]]:
        """The arguments of a call of a data class, each with its field."""
        fields = [p.name for p in self._decorators.parameters(name) or ()]
        if any(a.stars for a in call.arguments):
            yield from ((field, ANY_VALUE) for field in fields)
        plain = [a.value for a in call.arguments if a.name is None]
        yield from zip(fields, plain, strict=False)
        yield from ((a.name, a.value) for a in call.arguments if a.name in fields and a.name)

    def messages(self, function: str, parameter: str) -> list[str]:
        """The types of the messages that subscriptions give for a parameter."""
        return self._subscribed.get((function, parameter), [])

    @cached_property
    def declared(self) -> dict[str, list[tuple[str, e.Expression]]]:
        """By each parameter of nodes its defaults, with the functions that declare them."""
        found: dict[str, list[tuple[str, e.Expression]]] = {}
        for name, node in walk_all(self._program):
            for asked, default in _declared(node):
                found.setdefault(asked, []).append((name, default))
        return found

    @cached_property
    def escaping(self) -> frozenset[str]:
        """The functions that are named otherwise than to be called: what they get is not known.

        What subscriptions and services give is known, and so is what Python's own give for each
        element.
        """
        last = {name.rpartition(".")[2].rpartition(":")[2] for name in self._program.functions}
        found = set[str]()
        for name in self._program.functions:
            around = self._program.function(name)
            known = {id(each) for node in walk(around) for each in self._known_uses(node, name)}
            for node in walk(around):
                match node:
                    case e.Attribute(name=named) | e.Global(name=named) if named in last:
                        pass
                    case e.Closure() | e.Local() | e.Captured() | e.Temporary():
                        pass
                    case _:
                        continue
                if id(node) not in known:
                    found |= self._graph.value(node, around).functions
        return frozenset(found)

    def _known_uses(self, node: object, function: str) -> Iterator[e.Expression]:
        """The values in a node that name functions of which it is known what they get there."""
        match node:
            case s.Assign(_, e.Closure() as value):  # which defines it
                yield value
            case s.Assign(e.Temporary(), value):
                yield value
            case s.Call(_, s.ValueCallee(value), arguments):
                yield value
                made_by = self._origins.of(value, function)  # `@lru_cache(maxsize=None)`
                if made_by and all(
                    isinstance(o, LibraryOrigin) and o.name in KEEPING for o in made_by
                ):
                    yield from (a.value for a in arguments)
            case s.Call(_, s.LibraryCallee(name), arguments) if name in _KNOWN_USERS:
                yield from (a.value for a in arguments)
            case s.DefineClass(_, _, bases):  # whose constructor calls of the class run
                yield from (a.value for a in bases if a.name is None)
            case _:
                pass
        target = getattr(node, "target", None)
        yield from [] if target is None else [target]
        if isinstance(node, s.Call):
            if self._orders(node):
                yield from (a.value for a in node.arguments if a.name == "key")
            yield from (callback for _, callback in _other_callbacks(node))
            for kind in (Kind.SUBSCRIPTION, Kind.SERVICE):
                yield from (callback for _, callback in _asked(node, kind))

    @cached_property
    def _given(self) -> dict[tuple[str, str], list[Source]]:
        found: dict[tuple[str, str], list[Source]] = {}
        for name in self._program.functions:
            around = self._program.function(name)
            for node in walk(around):
                match node:
                    case s.Call():
                        for called in self.called(node, around):
                            given = bound(node, self._program.function(called))
                            for parameter, value in given.items():
                                found.setdefault((called, parameter), []).append((name, value))
                        for called, values in self._called_for_each(node, around):
                            of_call = own_parameters(self._program.function(called))
                            for parameter, each in zip(of_call, values, strict=False):
                                known = found.setdefault((called, parameter), [])
                                known += ((name, value) for value in each)
                    case e.Closure(of, _, defaults):
                        for parameter, value in defaults:
                            found.setdefault((of, parameter), []).append((name, value))
                    case _:
                        pass
        return found

    def called(self, call: s.Call, around: Function) -> frozenset[str]:
        """The functions of the program that a call reaches, as far as that is known."""
        match call.callee:
            case s.FunctionCallee(name):
                return frozenset({name})
            case s.ValueCallee(value):
                held = self._origins.of(value, around.name)  # decorated ones too
                return self._graph.value(value, around).functions | self._run_by(held)
            case s.MethodCallee(_, name, _, str() as after):
                return self._nearest(self._graph.bases(after), name)
            case s.MethodCallee(receiver, name, None, None) as callee if (
                owner := self._graph.class_of(receiver, around)
            ) is not None:
                found = self._graph.callee(callee, around).functions
                return found if self._origins.methods(owner, name) else found | self._kept(name)
            case s.MethodCallee(receiver, name, None, None):
                held = self._origins.of(receiver, around.name)
                classes = [o.name for o in held if isinstance(o, ClassOrigin)]
                methods = (self._origins.methods(each, name) for each in classes)
                found = frozenset[str]().union(*methods)
                return found if found or not classes else self._kept(name)
            case _:
                return frozenset()

    def _run_by(self, held: Iterable[Origin]) -> frozenset[str]:
        """The functions that calls of some values run: of classes the constructors."""
        found = frozenset[str]()
        for origin in held:
            match origin:
                case FunctionOrigin(name):
                    found |= {name}
                case ClassOrigin(name, of_object):
                    method = "__call__" if of_object else "__init__"
                    found |= self._nearest([name, *self._graph.bases(name)], method)
                case _:
                    pass
        return found

    def _nearest(self, line: Iterable[str], method: str) -> frozenset[str]:
        """The function that the first of some classes that has it has for a method."""
        classes = (self._program.classes.get(name) for name in line)
        methods = (dict(c.methods) for c in classes if c is not None)
        return frozenset(next(({m[method]} for m in methods if method in m), ()))

    def _kept(self, name: str) -> frozenset[str]:
        """The functions that are stored under the name of an attribute."""
        stored = self._graph.stores.of(Member(name))
        return frozenset[str]().union(*(self._run_by(self._origins.of_stored(v)) for v in stored))

    def _called_for_each(
        self, call: s.Call, around: Function
    ) -> Iterator[tuple[str, list[list[Drawn | Value]]]]:
        """The functions that one of Python's calls for each element, with what these get."""
        match call:
            case s.Call(_, s.LibraryCallee(name), (function, container)) if name in _FOR_EACH:
                values, elements = [function.value], container.value
            case s.Call(_, s.LibraryCallee("functools.reduce"), (function, container, *first)):
                element = ElementOf(container.value)
                for called in self._graph.value(function.value, around).functions:
                    result = CallResult(s.Call(None, s.FunctionCallee(called), ()))
                    yield called, [[element, result, *(a.value for a in first)], [element]]
                return
            case s.Call(_, s.LibraryCallee(), (container, *more)) if self._orders(call):
                values, elements = [a.value for a in more if a.name == "key"], container.value
            case s.Call(_, s.MethodCallee(elements, "sort"), named) if self._orders(call):
                values = [a.value for a in named if a.name == "key"]
            case _:
                return
        for value in values:
            for called in self._graph.value(value, around).functions:
                yield called, [[ElementOf(elements)]]

    def _orders(self, call: s.Call) -> bool:
        """Whether what a call gets as its `key` is called with elements, by Python's own."""
        match call.callee:
            case s.LibraryCallee(name):
                return self._origins.table.is_of_language(name)
            case s.MethodCallee(_, name):
                return name == "sort" and not self._origins.methods_of_any(name)
            case _:
                return False

    @cached_property
    def _subscribed(self) -> dict[tuple[str, str], list[str]]:
        found: dict[tuple[str, str], list[str]] = {}
        for name, node in walk_all(self._program):
            for type_, callback in _asked(node, Kind.SUBSCRIPTION):
                for called in callback_functions(self._graph, callback, name):
                    for parameter in first_parameter(self._program.function(called)):
                        known = found.setdefault((called, parameter), [])
                        known += self.messages_of(type_, name)
            for gets, callback in _other_callbacks(node):
                for called in callback_functions(self._graph, callback, name):
                    for parameter in first_parameter(self._program.function(called)):
                        found.setdefault((called, parameter), []).append(gets)
            for type_, callback in _asked(node, Kind.SERVICE):
                for called in callback_functions(self._graph, callback, name):
                    of_call = own_parameters(self._program.function(called))
                    for parameter, part in zip(of_call, _PARTS, strict=False):
                        known = found.setdefault((called, parameter), [])
                        known += [f"{each}_{part}" for each in self.messages_of(type_, name)]
        return found

    def messages_of(self, type_: e.Expression, function: str) -> Iterator[str]:
        """The messages, or services, that a value may be the class of."""
        held = self._origins.of(type_, function)
        names = [o.name for o in held if isinstance(o, LibraryOrigin) and not o.of_object]
        if isinstance(type_, e.Global) and not names:
            names = [f"{module}.{type_.name}" for module in self._imported_whole(type_.module)]
        yield from filter(None, map(message_name, names))

    def _imported_whole(self, module: str) -> Iterator[str]:
        """The modules of libraries of which a module imports all names."""
        body = self._program.modules.get(module)
        for node in walk(self._program.function(body)) if body is not None else ():
            if isinstance(node, s.Import) and node.name == "*" and not node.is_program:
                yield node.module


def parameter_of(call: s.Call) -> tuple[str, Access, e.Expression | None] | None:
    """The parameter that a call asks a node for, by its name, how, and its default."""
    routine = _routine(call)
    if routine is None or routine.kind is not Kind.PARAMETER or routine.access is None:
        return None
    name, default = (_argument(call, routine, role) for role in ("name", "default"))
    match name:
        case e.Literal(str() as text):
            return text, routine.access, default
        case _:
            return None


def _declared(node: object) -> Iterator[tuple[str, e.Expression]]:
    """The parameters that a call declares, each with its default."""
    match node:
        case s.Call(
            _,
            s.MethodCallee(_, "declare_parameters"),
            (s.CallArgument(e.Literal("")), s.CallArgument(e.Build(_, entries))),
        ):
            for entry in entries:
                match entry:
                    case e.Build(_, (e.Literal(str() as name), default, *_)):
                        if not isinstance(default, e.Spread):
                            yield name, default
                    case _:
                        pass
        case s.Call() if (asked := parameter_of(node)) and asked[1] is Access.DECLARE:
            yield asked[0], asked[2] or e.Literal(None)
        case _:
            pass


def _routine(call: s.Call) -> Routine | None:
    match call.callee:
        case s.LibraryCallee(name):
            return python.function(name, len(call.arguments))
        case s.MethodCallee(_, name):
            return python.node_method(name)
        case _:
            return None


def _asked(node: object, kind: Kind) -> Iterator[tuple[e.Expression, e.Expression]]:
    """The types and callbacks of the subscriptions, or services, that a call asks for."""
    routine = _routine(node) if isinstance(node, s.Call) else None
    if isinstance(node, s.Call) and routine is not None and routine.kind is kind:
        type_, callback = (_argument(node, routine, role) for role in ("type", "callback"))
        if type_ is not None and callback is not None:
            yield type_, callback


def _other_callbacks(node: object) -> Iterator[tuple[str, e.Expression]]:
    """The callbacks of a call that get no messages, with the class of what they get."""
    if not isinstance(node, s.Call):
        return
    known = CALLBACKS.get(getattr(node.callee, "name", ""))
    if known is not None and known.gets:
        plain = [a.value for a in node.arguments if a.name is None and not a.stars]
        named = (a.value for a in node.arguments if a.name == known.name)
        yield from ((known.gets, each) for each in (*plain[known.at : known.at + 1], *named))


def _argument(call: s.Call, routine: Routine, role: str) -> e.Expression | None:
    """The argument of a call with a role, by place or by name."""
    plain = [a.value for a in call.arguments if a.name is None and not a.stars]
    by_place = dict(zip(routine.arguments, plain, strict=False))
    names = {role, *(name for name, of in routine.keywords if of == role)}
    named = (a.value for a in call.arguments if a.name in names)
    return by_place.get(role, next(named, None))
