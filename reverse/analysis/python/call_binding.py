"""Whether Python takes the arguments of a call: how they are bound to the parameters of a function.

See "Calls" in the language reference: arguments by place fill parameters from the left, those by
name fill the ones of their names, and each parameter without a default must be filled once.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import takewhile

from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.python.class_decorators import ClassDecorators
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import ImplicitCall
from rebsync.reverse.ir.program import Function, Parameter, ParameterKind
from rebsync.reverse.ir.walk import walk_all
from rebsync.reverse.libraries.callbacks import CALLBACKS

REFUSED = "gets other arguments than it takes"
_WITH_KEYS = frozenset({"builtins.sorted", "builtins.max", "builtins.min"})
_BY_PLACE = (ParameterKind.PLAIN, ParameterKind.BY_PLACE)
_BY_NAME = (ParameterKind.PLAIN, ParameterKind.BY_NAME)
# Decorators of libraries that leave the parameters of a function as they are.
KEEPING = frozenset(
    f"{module}.{name}"
    for module, names in (
        ("builtins", "staticmethod classmethod property"),
        ("abc", "abstractmethod"),
        ("typing", "override final"),
        ("typing_extensions", "override"),
        ("functools", "lru_cache cache"),
        ("contextlib", "contextmanager"),
    )
    for name in names.split()
)


def refuses(arguments: Sequence[s.CallArgument], parameters: Sequence[Parameter]) -> bool:
    """Whether parameters may not take some arguments, of which those with stars may be any."""
    by_place = sum(a.name is None and not a.stars for a in arguments)
    names = [a.name for a in arguments if a.name is not None]
    kinds = {p.kind for p in parameters}
    placed = [p for p in parameters if p.kind in _BY_PLACE]
    has_rest, has_named = ParameterKind.REST in kinds, ParameterKind.NAMED_REST in kinds
    stars = {a.stars for a in arguments}
    if (by_place > len(placed) or 1 in stars) and not has_rest:
        return True
    if 2 in stars and not has_named:
        return True
    known = {p.name for p in parameters if p.kind in _BY_NAME}
    first = {p.name for p in placed[:by_place]}
    if any(n in first & known or (n not in known and not has_named) for n in names):
        return True
    filled = first.union(names)
    required = (p for p in parameters if p.kind in {*_BY_PLACE, *_BY_NAME} and not p.has_default)
    return any(p.name not in filled for p in required)


def bound(call: s.Call | s.Construct, called: Function) -> dict[str, e.Expression]:
    """The arguments of a call by the parameters that they are for."""
    places = [p.name for p in called.parameters if p.kind in _BY_PLACE]
    is_function = isinstance(call, s.Call) and isinstance(call.callee, s.FunctionCallee)
    if called.receiver is not None and not is_function:
        places = [name for name in places if name != called.receiver]
    first = takewhile(lambda a: not a.stars, call.arguments)  # behind these no place is known
    by_place = [a.value for a in first if a.name is None]
    by_name = {a.name: a.value for a in call.arguments if a.name is not None}
    return {**dict(zip(places, by_place, strict=False)), **by_name}


class CallBinding:
    """The calls of one program; compilers of other languages than Python refuse such themselves."""

    def __init__(self, graph: CallGraph, decorators: ClassDecorators, is_python: bool) -> None:
        self._graph = graph
        self._decorators = decorators
        self._program = graph.program
        self._is_python = is_python

    def of_method(self, call: s.Call, of: str, name: str, is_object: bool) -> bool:
        """Whether a method of an object of just that class, or of the class, may refuse a call."""
        found = self._nearest([of, *self._graph.bases(of)], name)
        return found is not None and self._refuses(call, found, is_object)

    def of_own_method(self, call: s.Call, of: str, name: str) -> bool:
        """Whether a method that a class calls on itself may refuse the call: of those below too."""
        below = self._graph.subclasses.get(of, {of})
        return any(self.of_method(call, each, name, True) for each in below)

    def of_base(self, call: s.Call, after: str, name: str) -> bool:
        """Whether the method that follows those of a class refuses the arguments."""
        bases = self._graph.bases(after)
        if not self._is_python or any(b not in self._program.classes for b in bases):
            return False  # a library's may come first
        nearest = self._nearest(bases, name)
        return nearest is not None and self._refuses(call, nearest, True)

    def of_function(self, call: s.Call, name: str) -> bool:
        """Whether a function refuses the arguments: a method with and without its object."""
        if not self._is_python or name in self._wrapped:
            return False
        function = self._program.function(name)
        ways = [function.parameters]
        if function.owner is not None:
            ways.append(function.parameters[1:])
        return all(refuses(call.arguments, each) for each in ways)

    def of_handed(self, call: s.Call, argument: s.CallArgument, name: str) -> bool:
        """Whether a function is handed to one of Python's that calls it otherwise than it takes."""
        match call.callee:
            case s.LibraryCallee("builtins.map") if argument is call.arguments[0]:
                count = len(call.arguments) - 1
            case s.LibraryCallee("functools.reduce") if argument is call.arguments[0]:
                count = 2
            case s.LibraryCallee("builtins.filter") if argument is call.arguments[0]:
                count = 1
            case s.LibraryCallee(called) if called in _WITH_KEYS and argument.name == "key":
                count = 1
            case s.MethodCallee(_, "sort") if argument.name == "key":
                count = 1
            case _:
                return False
        given = (s.CallArgument(e.Literal(0)),) * count
        return self.of_function(s.Call(None, call.callee, given), name)

    def of_callback(self, call: s.Call, around: Function) -> bool:
        """Whether a client library may call back a function otherwise than it takes."""
        if not self._is_python or not isinstance(call.callee, s.MethodCallee | s.LibraryCallee):
            return False
        callback = CALLBACKS.get(call.callee.name)
        if callback is None:
            return False
        plain = [a.value for a in call.arguments if a.name is None and not a.stars]
        named = [a.value for a in call.arguments if a.name == callback.name]
        is_more = len(plain) > callback.at + 1 or any(
            a.name == callback.more for a in call.arguments
        )
        count = callback.count + (bool(callback.more) and is_more)
        arguments = (s.CallArgument(e.Literal(0)),) * count
        given = (*plain[callback.at : callback.at + 1], *named)
        return any(self._is_refused(value, around, arguments) for value in given)

    def _is_refused(
        self, callback: e.Expression, around: Function, arguments: Sequence[s.CallArgument]
    ) -> bool:
        """Whether a callback that a function hands over takes no such arguments."""
        called = s.Call(None, s.ValueCallee(callback), tuple(arguments))
        match callback:
            case e.Attribute(of, name) if (owner := self._graph.class_of(of, around)) is not None:
                return self.of_own_method(called, owner, name)
            case e.Global(module, name) if f"{module}:{name}" in self._program:
                return self.of_function(called, f"{module}:{name}")
            case e.Closure(name):
                return self.of_function(called, name)
            case _:
                return False

    def of_class(self, call: s.Call, name: str) -> bool:
        """Whether a class cannot be called with the arguments, or has abstract methods."""
        if not self._is_python:
            return False
        line = [name, *self._graph.bases(name)]
        classes_there = [self._program.classes[c] for c in line if c in self._program.classes]
        methods = {m for c in classes_there for m, _ in c.methods}
        if any(self._nearest(line, method) in self._abstract for method in methods):
            return True
        fields = self._decorators.parameters(name)
        if fields is not None:
            return refuses(call.arguments, fields)
        classes = [self._program.classes.get(c) for c in line]
        if any(c is None or not c.complete for c in classes):
            return False  # a library, a decorator or a class of classes may take them
        makers = {
            method
            for c in classes
            for implicit, method in (c.operators if c is not None else ())
            if implicit is ImplicitCall.CONSTRUCT
        }
        if not makers:
            return bool(call.arguments)
        return makers == {"__init__"} and self.of_method(call, name, "__init__", True)

    def _nearest(self, line: Sequence[str], name: str) -> str | None:
        """The function that the first of some classes has under the name of a method."""
        if not self._is_python:
            return None
        classes = (self._program.classes.get(each) for each in line)
        methods = (dict(c.methods) for c in classes if c is not None)
        return next((found[name] for found in methods if name in found), None)

    def _refuses(self, call: s.Call, name: str, is_object: bool) -> bool:
        function = self._program.function(name)
        if name in self._wrapped:
            return False
        is_method = function.receiver is not None or not function.parameters
        if name in self._static or (is_method and not is_object):
            return refuses(call.arguments, function.parameters)
        return not function.parameters or refuses(call.arguments, _parameters_behind(function))

    @cached_property
    def _abstract(self) -> frozenset[str]:
        """The methods that classes of objects must define anew."""
        return self._decorated({"abc.abstractmethod"})

    @cached_property
    def _static(self) -> frozenset[str]:
        """The functions that are static methods of classes."""
        return self._decorated({"builtins.staticmethod"})

    @cached_property
    def _wrapped(self) -> frozenset[str]:
        """The functions in whose place a decorator may put one with other parameters."""
        return self._decorated(None)

    def _decorated(self, names: set[str] | None) -> frozenset[str]:
        """The functions that some functions of libraries get alone, or (None) any unknown ones."""
        found = set[str]()
        for _, node in walk_all(self._program):
            match node:
                case s.Call(_, callee, (s.CallArgument(e.Closure(function)),)):
                    known = callee.name if isinstance(callee, s.LibraryCallee) else ""
                    is_asked = known not in KEEPING if names is None else known in names
                    found |= {function} if is_asked else set()
                case _:
                    pass
        return frozenset(found)


def _parameters_behind(function: Function) -> Sequence[Parameter]:
    """The parameters behind the one for the object, unless that is one of any number."""
    first = function.parameters[:1]
    is_rest = any(p.kind is ParameterKind.REST for p in first)
    return function.parameters if is_rest else function.parameters[1:]
