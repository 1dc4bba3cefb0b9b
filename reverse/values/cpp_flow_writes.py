"""The definitions of variables in functions, and the functions that give members a value."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.cpp_calls import call_around
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_flow import Texts
from rebsync.reverse.values.cpp_flow_calls import Calls
from rebsync.reverse.values.cpp_flow_definitions import Definition, definitions
from rebsync.reverse.values.cpp_flow_reach import Located, located
from rebsync.reverse.values.cpp_flow_types import Types, Variable, unscoped_member

FORMATS = frozenset({"sprintf", "snprintf"})
_DEEPEST = 30
_READERS = frozenset({"getline", "get", "sscanf", "scanf", "read", "fread"})
Key = tuple[int, str, str]


def key_of(variable: Variable, path: str) -> Key:
    """What tells a variable, or a field of one, from others."""
    return variable.name.id, variable.text, path


@dataclass(slots=True)
class Writes:
    """Finds what gives variables their values."""

    texts: Texts
    types: Types
    calls: Calls
    _writers: dict[Key, list[CppFunction]] = field(default_factory=dict)
    _changing: dict[tuple[int, int, str], bool] = field(default_factory=dict)
    _depth: int = 0
    _found: dict[tuple[int, Key], list[Located]] = field(default_factory=dict)

    def within(self, variable: Variable, path: str, function: CppFunction) -> list[Located]:
        """The definitions of a variable, or of a field of it, in a function, the latest first."""
        key = function.node.id, key_of(variable, path)
        if key not in self._found:
            self._found[key] = []  # while they are looked for
            found = [*self._own(variable, path, function)]
            if variable.kind in ("member", "global"):
                found += self._by_calls(variable, path, function)
            self._found[key] = located(found)
        return self._found[key]

    def _own(self, variable: Variable, path: str, function: CppFunction) -> Iterator[Definition]:
        node = function.node
        if variable.kind in ("local", "lambda") and variable.scope is not None:
            node = variable.scope
        texts = self.texts
        if variable.kind in ("local", "parameter", "lambda") and variable.cpp is not function.cpp:
            return
        found = definitions(texts, function.cpp, variable, path, node.start_byte, node.end_byte)
        for definition in found:
            if definition.how == "given" and not self._may_change(definition, path, function.cpp):
                continue
            if variable.kind in ("member", "global") and self._hidden(
                definition, variable, function
            ):
                continue
            yield definition

    def _hidden(self, definition: Definition, variable: Variable, function: CppFunction) -> bool:
        """Whether a name stands for a local variable of the same name."""
        if definition.how == "initialised":
            return False
        meant = self.types.variable(function.cpp, definition.place)
        return meant is not None and meant.name.id != variable.name.id

    def _by_calls(
        self, variable: Variable, path: str, function: CppFunction
    ) -> Iterator[Definition]:
        """Calls of functions that give the variable a value."""
        calls = self.calls
        start, end = function.node.start_byte, function.node.end_byte
        for writer in self.writing(variable, path):
            if writer.node == function.node or writer.name == function.owner:
                continue
            for place in self.texts.within(function.cpp, writer.name, start, end):
                call = call_around(place)
                if call is None or not text_of(part(call, "function")).endswith(writer.name):
                    continue
                if any(f.node == writer.node for f in calls.functions(function.cpp, call)):
                    yield Definition("called", place, call, text=str(writer.node.id))

    def _may_change(self, definition: Definition, path: str, cpp: Cpp) -> bool:
        """Whether a call may change what it is given, or a field of it."""
        function = part(definition.node, "function")
        name, scope = called_name(function)
        if role_of(name, scope, definition.index, len(named(part(definition.node, "arguments")))):
            return True
        if _asks_for(name, function):
            return False
        if name in _READERS and function.type != "field_expression":
            return True
        return any(
            self._changes(f, definition.index, path)
            for f in self.calls.functions(cpp, definition.node)
        )

    def _changes(self, function: CppFunction, index: int, path: str) -> bool:
        """Whether a function gives what is handed to it by reference another value."""
        if index >= len(function.parameters):
            return False
        key = function.node.id, index, path
        if key not in self._changing:
            if self._depth > _DEEPEST:
                return True
            self._changing[key] = False  # while it is looked for
            inner = parameter_variable(function, index)
            self._depth += 1
            self._changing[key] = (
                inner is not None
                and _by_reference(function.parameters[index].node)
                and any(True for _ in self._own(inner, path, function))
            )
            self._depth -= 1
        return self._changing[key]

    def writing(self, variable: Variable, path: str) -> list[CppFunction]:
        """The functions that give a member or global a value themselves."""
        key = key_of(variable, path)
        if key not in self._writers:
            self._writers[key] = []
            named_by: dict[int, CppFunction] = {}
            for cpp, place in self.texts.everywhere(variable.text):
                function = self.texts.function_around(cpp, place)
                if function is not None:
                    named_by.setdefault(function.node.id, function)
            self._writers[key] = [
                f
                for f in named_by.values()
                if self._may_name(variable, f) and any(True for _ in self._own(variable, path, f))
            ]
        return self._writers[key]

    def _may_name(self, variable: Variable, function: CppFunction) -> bool:
        if variable.owner is None:
            return True
        class_ = self.texts.class_of(function)
        return class_ is not None and variable.owner in self.texts.lineage(class_)


def parameter_variable(function: CppFunction, index: int) -> Variable | None:
    """A parameter of a function as a variable."""
    if index >= len(function.parameters):
        return None
    parameter = function.parameters[index]
    name = parameter.node.child_by_field_name("declarator")
    while name is not None and name.type != "identifier":
        name = name.named_children[-1] if name.named_children else None
    if name is None:
        return None
    return Variable(
        "parameter",
        parameter.name,
        function.cpp,
        name,
        parameter.type,
        function.node,
        index=index,
    )


def called_name(function: Node) -> tuple[str, str]:
    """The name of a called function and the scope before it."""
    if function.type == "field_expression":
        return unscoped_member(part(function, "field")), "."
    scope = ""
    while function.type == "qualified_identifier":
        above = function.child_by_field_name("scope")
        scope = text_of(above) if above is not None else ""
        function = part(function, "name")
    return unscoped_member(function), scope


def role_of(name: str, scope: str, index: int, count: int) -> str:
    """The role of an argument that a call fills: `format`, or for a parameter; or empty."""
    on_handles, functions = libraries.handle_methods(), libraries.functions()
    ask = on_handles.get(name) if scope == "." else functions.get((scope, name))
    if ask is None and scope in ("", "."):
        ask = libraries.node_methods().get(name)
    if name in FORMATS and scope in ("", "std") and index == 0:
        return "format"
    if ask is None or ask.kind is not Kind.PARAMETER or index >= len(ask.arguments):
        return ""
    role = ask.arguments[index]
    if role == "variable" and "default" in ask.arguments and count == 2:
        return ""  # `param(name, default)`
    return role if role in ("variable", "found") else ""


def _asks_for(name: str, function: Node) -> bool:
    """Whether a call asks for something by a method of a handle or a node."""
    is_method = function.type == "field_expression"
    return (is_method and name in libraries.handle_methods()) or name in libraries.node_methods()


def _by_reference(parameter: Node) -> bool:
    """Whether a parameter is a reference or pointer to what is not constant."""
    declarator = parameter.child_by_field_name("declarator")
    if declarator is None or declarator.type not in ("reference_declarator", "pointer_declarator"):
        return False
    return not any(
        c.type == "type_qualifier" and text_of(c) == "const" for c in parameter.named_children
    )
