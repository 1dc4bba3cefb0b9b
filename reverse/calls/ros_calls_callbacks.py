"""The functions that code hands to ROS to be called: by pointer, bind, lambda, functor or name."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import Callback, Unresolved
from rebsync.reverse.syntax.cpp_declarations import lambda_parameters, name_of_parameter
from rebsync.reverse.syntax.cpp_index import CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_flow import nearness
from rebsync.reverse.values.cpp_flow_types import unscoped_member
from rebsync.reverse.values.cpp_values import Values
from rebsync.reverse.values.cpp_values_plain import Frame, Function, Made, Value, at, ways

_FUNCTOR = "operator()"


@dataclass(frozen=True, slots=True)
class Called:
    """A callback, and the type of what it is called with, if the code says it."""

    callback: Callback | Unresolved
    cpp: Cpp
    type: Node | None = None


@dataclass(slots=True)
class Callbacks:
    """Finds out which functions an argument stands for."""

    values: Values

    def of(self, node: Node, frame: Frame) -> list[Called]:
        """What may be called where a node is given for a callback. Open: as `Values.value`."""
        return [
            c for way in ways(self.values.value(node, frame)) for c in self._one(way, node, frame)
        ]

    def _one(self, value: Value, node: Node, frame: Frame) -> Iterator[Called]:
        match value:
            case Function(found, inner):
                yield from self._function(found, inner)
            case Made(type_) as made:
                yield self._functor(made, type_, node, frame)
            case Unresolved():
                yield Called(value, frame.cpp)
            case _:
                yield Called(
                    self.values.unknown("no function that is known", node, frame), frame.cpp
                )

    def _function(self, node: Node, frame: Frame) -> Iterator[Called]:
        cpp = frame.cpp
        match node.type:
            case "lambda_expression":
                inner = self._handed_on(node, cpp)
                label = f"{inner.owner}::{inner.name}" if inner is not None else ""
                lambda_ = node if inner is None else None
                found = Callback(label, at(cpp, node), inner, lambda_)
                yield Called(found, cpp, _lambda_type(node))
            case "call_expression":
                yield from self._bound(node, frame)
            case "pointer_expression":
                yield self._member(part(node, "argument"), cpp)
            case _:
                yield self._free(node, cpp)

    def _bound(self, node: Node, frame: Frame) -> Iterator[Called]:
        """`bind(&C::f, this, _1, x)`."""
        given = named(part(node, "arguments"))
        for called in self.of(given[0], frame) if given else []:
            callback = called.callback
            if isinstance(callback, Unresolved):
                yield called
                continue
            function, rest = callback.function, given[1:]
            if "::" in callback.name and given[0].type == "pointer_expression":
                rest = rest[1:]  # the object
            bound = tuple(a for a in rest if not _placeholder(a))
            place = at(frame.cpp, node)
            found = Callback(
                callback.name, place, function, callback.lambda_, bound, callback.through
            )
            type_ = called.type
            if function is not None and (index := _first(rest)) is not None:
                type_ = _type_at(function, index)
            yield Called(found, called.cpp, type_)

    def _member(self, node: Node, cpp: Cpp) -> Called:
        """`&C::f`, or `&f` of a free function."""
        scope, name = _qualified(node)
        owner = self.values.texts.class_near(scope, cpp) if scope else None
        if owner is None:
            return self._free(node, cpp)
        function = self._method(owner, name)
        callback = Callback(f"{self._label(node, cpp)}::{name}", at(cpp, node), function)
        return Called(callback, *self._typed(function, cpp))

    def _label(self, node: Node, cpp: Cpp) -> str:
        """The classes around a name, as the code names them: `Outer::Inner`."""
        scopes = []
        while node.type == "qualified_identifier":
            above = node.child_by_field_name("scope")
            scopes.append(text_of(above).partition("<")[0] if above is not None else "")
            node = part(node, "name")
        classes = [s for s in scopes[:-1] if self.values.texts.class_near(s, cpp) is not None]
        return "::".join([*classes, scopes[-1]])

    def _method(self, owner: CppClass, name: str) -> CppFunction | None:
        """The method of a class or of one above, with its body if it has one."""
        lineage = self.values.texts.lineage(owner)
        for class_ in lineage:
            if found := self.values.calls.bodies(class_, name):
                return found[0]
        return next((f for c in lineage for f in c.functions if f.name == name), None)

    def _typed(self, function: CppFunction | None, cpp: Cpp) -> tuple[Cpp, Node | None]:
        return (function.cpp, _type_at(function, 0)) if function is not None else (cpp, None)

    def _free(self, node: Node, cpp: Cpp) -> Called:
        scope, name = _qualified(node)
        found = self.values.code.definitions.get(("", name), [])
        best = max(found, key=lambda f: nearness(f.cpp, cpp)) if found else None
        label = name if best is not None or not scope else f"{scope}::{name}"
        return Called(Callback(label, at(cpp, node), best), *self._typed(best, cpp))

    def _functor(self, made: Made, type_: str, node: Node, frame: Frame) -> Called:
        name = type_.rpartition("::")[2]
        owner = self.values.texts.class_near(name, frame.cpp)
        function = self._method(owner, _FUNCTOR) if owner is not None else None
        if owner is None or function is None:
            why = f"no class {name} that can be called is in the files"
            return Called(self.values.unknown(why, node, frame), frame.cpp)
        label = f"{owner.outer}::{name}" if owner.outer else name
        inner = self._only_call(function)
        place = at(made.use.cpp, made.use.node)
        if inner is not None:
            callback = Callback(f"{inner.owner}::{inner.name}", place, inner, through=label)
        else:
            callback = Callback(f"{label}::{_FUNCTOR}", place, function, through=label)
        return Called(callback, *self._typed(function, frame.cpp))

    def _handed_on(self, node: Node, cpp: Cpp) -> CppFunction | None:
        """The method that a lambda does nothing but call on `this`, with what it gets itself."""
        body = node.child_by_field_name("body")
        statements = named(body) if body is not None else []
        inside = named(statements[0]) if len(statements) == 1 else []
        if len(inside) != 1 or inside[0].type != "call_expression":
            return None
        call = inside[0]
        function = part(call, "function")
        on_this = function.type == "identifier" or (
            function.type == "field_expression" and part(function, "argument").type == "this"
        )
        given = [text_of(a) for a in named(part(call, "arguments"))]
        if not on_this or given != [*map(name_of_parameter, lambda_parameters(node))]:
            return None
        found = self.values.calls.functions(cpp, call)
        return found[0] if len(found) == 1 and found[0].owner else None

    def _only_call(self, function: CppFunction) -> CppFunction | None:
        """The method that a functor does nothing but call."""
        statements = named(function.body) if function.body is not None else []
        inside = named(statements[0]) if len(statements) == 1 else []
        if not inside or inside[0].type != "call_expression":
            return None
        found = self.values.calls.functions(function.cpp, inside[0])
        return found[0] if len(found) == 1 and found[0].owner else None


def _qualified(node: Node) -> tuple[str, str]:
    """The scope next to a name, without the arguments of templates, and the name."""
    scope = ""
    while node.type == "qualified_identifier":
        above = node.child_by_field_name("scope")
        scope = text_of(above).partition("<")[0] if above is not None else ""
        node = part(node, "name")
    return scope, unscoped_member(node)


def _placeholder(node: Node) -> bool:
    text = text_of(node).rpartition("::")[2]
    return text.startswith("_") and text[1:].isdigit()


def _first(arguments: list[Node]) -> int | None:
    """Where `_1` stands."""
    for index, argument in enumerate(arguments):
        if text_of(argument).rpartition("::")[2] == "_1":
            return index
    return None


def _type_at(function: CppFunction, index: int) -> Node | None:
    return function.parameters[index].type if index < len(function.parameters) else None


def _lambda_type(node: Node) -> Node | None:
    first = lambda_parameters(node)[:1]
    return first[0].child_by_field_name("type") if first else None
