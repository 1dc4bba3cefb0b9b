"""Calls that may run code of which no file that was read has the body: unresolved calls.

Such code may do anything to what it can reach: it may change what the node has, publish, or throw.
What the files declare without a body, or leave to whoever derives a class, is code of theirs, which
knows their variables. An object that somebody else made, and handed to the node, may have been told
of it. What a library has, and got nothing of the node, can reach nothing of it.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_enum_operators import EnumOperators
from rebsync.reverse.bodies.effects.cpp_implicit_calls import (
    COMPARING,
    OPERATORS,
    UnwrittenCalls,
    operators,
)
from rebsync.reverse.bodies.effects.cpp_known_objects import KnownObjects
from rebsync.reverse.bodies.effects.cpp_object_parts import UNDEFINED as _UNDEFINED
from rebsync.reverse.bodies.effects.cpp_object_parts import ObjectParts
from rebsync.reverse.bodies.effects.cpp_provenance import Provenance, ProvenanceAnalysis
from rebsync.reverse.bodies.effects.cpp_undefined import Undefined, is_defaulted, is_library
from rebsync.reverse.bodies.effects.known_functions import is_known, is_matrix
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.tables.standard import OF_C
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_index import Code, CppClass
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_flow import Texts, made_of
from rebsync.reverse.values.cpp_flow_calls import Calls
from rebsync.reverse.values.cpp_flow_types import Types, Variable, unscoped_member
from rebsync.reverse.values.cpp_static_types import (
    POINTING,
    StaticType,
    StaticTypes,
    is_arrow,
)

_OVERRIDDEN = "a class that was not read may override it"
_INHERITED = "a class that was not read may have it"
_GIVEN = "nothing that was read makes the object"
_HELD = "which function is held there is not known"
_CALLED = frozenset({"function", "move_only_function", "signal", "packaged_task"})
# Functions of libraries that do not call what they get.
_KEEPING = frozenset(
    {"move", "forward", "ref", "cref", "bind", "swap", "exchange", "ignore_unused"}
)
# Methods of containers that make elements, or end some.
_MAKING = frozenset(
    {"emplace", "emplace_back", "emplace_front", "push_back", "push_front", "push", "insert"}
    | {"resize", "assign", "clear", "erase", "pop_back", "pop_front", "pop"}
)
# Methods of containers that compare no elements.
_COUNTING = frozenset({"size", "empty", "begin", "end", "cbegin", "cend", "front", "back", "data"})
_CALL = "operator()"
_TYPE_NAMES = frozenset({"type_identifier", "namespace_identifier"})
_NAMING = frozenset({"qualified_identifier", "template_type"})
_LEADING = frozenset({"pointer_declarator", "reference_declarator"})


class UnreadCalls:
    """Which calls of some code may run what was not read, and why; None for all others."""

    def __init__(self, code: Code) -> None:
        self._code = code
        self._texts = Texts(code)
        self._types = Types(self._texts)
        self._statics = StaticTypes(self._types)
        self._calls = Calls(self._texts, self._types)
        self._provenance = ProvenanceAnalysis(self._texts, self._calls, self._statics)
        self._open = Undefined(code, self._texts)
        self._parts = ObjectParts(self._texts, self._statics, self._open)
        self.objects = KnownObjects(code, self._statics)
        self.of_enums = EnumOperators(self._statics, self._open)
        self.implicit = UnwrittenCalls(
            self._texts, self._statics, self._calls, self._parts, self._of_converted
        )
        self._found: dict[int, str | None] = {}

    def of_call(self, cpp: Cpp, call: CppCall) -> str | None:
        """Why a call of a function or method may run what was not read."""
        key = call.node.id
        if key not in self._found:
            found = self._free(cpp, call) if call.target is None else self._method(cpp, call)
            self._found[key] = found or self.implicit.of_call(cpp, call)
        return self._found[key]

    def of_operator(self, cpp: Cpp, node: Node) -> str | None:
        """Why an operator may: of a class of the files, or declared by these alone."""
        if node.type == "assignment_expression" and self._open.has_undefined:
            left = self._statics.of(cpp, part(node, "left"))
            if left is not None and (why := self._held_object(left, "reset")) is not None:
                return why
        if not self._open.operators or node.type not in OPERATORS:
            return None
        if node.type == "field_expression" and not is_arrow(node):
            return None
        operands = [self._statics.of(cpp, part(node, each)) for each in OPERATORS[node.type]]
        if (why := self._parts.of_elements(operands)) is not None:
            return why
        names = operators(node) & self._open.operators
        owners = [o for each in operands if (o := self._statics.class_of(each)) is not None]
        if not names or not owners:
            return None
        if names & self._open.declared:
            return _UNDEFINED
        found = (self._by_operator(owner, name) for owner in owners for name in sorted(names))
        return next((why for why in found if why is not None), None)

    def _by_operator(self, owner: CppClass, name: str) -> str | None:
        """Why an operator of a class may; one that is defaulted runs those of the parts."""
        if self._declares(owner, name) and (why := self._of_class(owner, name, Provenance.MADE)):
            return why
        is_parts = any(is_defaulted(f) for f in owner.functions if f.name in COMPARING)
        parts = self._parts.within(owner) if is_parts else []
        return _UNDEFINED if any(self._open.lacks_body(c, name) for c in parts) else None

    def _of_converted(self, owner: CppClass, name: str) -> str | None:
        return self._of_class(owner, name, Provenance.MADE)

    def of_type(self, cpp: Cpp, type_: Node | None) -> str | None:
        """Why to make or end an object of a type may."""
        return self._parts.of_object(self._statics.written(cpp, type_))

    def made_with(self, cpp: Cpp, told: Node, is_value: bool) -> Iterator[tuple[Cpp, Node]]:
        """What is evaluated to make an object of a type, or of that of a value."""
        type_ = self._statics.of(cpp, told) if is_value else self._statics.written(cpp, told)
        if type_ is not None and not type_.pointers:
            yield from self.implicit.made_with(type_)

    def of_copied(self, cpp: Cpp, value: Node) -> str | None:
        """Why to make an object of a value may, where `auto` stands for its type."""
        return self._parts.of_object(self._statics.of(cpp, value))

    def of_handed(self, cpp: Cpp, argument: Node) -> str | None:
        """Why a function may that is handed on, or an object that is one: it may be called."""
        node = part(argument, "argument") if _is_address(argument) else argument
        if node.type in ("identifier", "qualified_identifier"):
            scope, _, name = "".join(text_of(node).split()).rpartition("::")
            owner = self._texts.class_near(scope.rpartition("::")[2], cpp) if scope else None
            if owner is not None and self._declares(owner, name):
                return self._of_class(owner, name, Provenance.MADE)
            is_variable = not scope and self._types.variable(cpp, node) is not None
            if name in self._open.declared and owner is None and not is_variable:
                return _UNDEFINED
        if _CALL not in self._open.operators:
            return None
        owner = self._statics.class_of(self._statics.of(cpp, argument))
        is_function = owner is not None and self._declares(owner, _CALL)
        return self._of_class(owner, _CALL, Provenance.MADE) if owner and is_function else None

    def of_deleted(self, cpp: Cpp, pointer: Node) -> str | None:
        """Why to end what a pointer leads to may."""
        type_ = self._statics.dereferenced(self._statics.of(cpp, pointer))
        return self._parts.of_object(type_, is_held=True)

    # --- functions outside of classes, and what is held in variables ----------------------------

    def _free(self, cpp: Cpp, call: CppCall) -> str | None:
        function = part(call.node, "function")
        if function.type not in ("identifier", "qualified_identifier", "template_function"):
            return None if function.type == "primitive_type" else self._held(cpp, function)
        scope, _, name = call.name.rpartition("::")
        last = function
        while last.type == "qualified_identifier":
            last = part(last, "name")
        types = named(part(last, "arguments")) if last.type == "template_function" else ()
        if types and text_of(part(last, "name")).startswith("make_"):
            return self.of_type(cpp, types[0])
        if scope:
            return self._of_scope(cpp, scope, name, call)
        variable = self._types.variable(cpp, function) if function.type == "identifier" else None
        if variable is not None:
            return self._variable(cpp, function, variable)
        around = self._texts.class_of(self._texts.function_around(cpp, call.node))
        if around is not None and self._declares(around, name):
            return self._of_class(around, name, Provenance.MADE)
        if name in self._code.all_classes:
            return self._parts.of_class(self._texts.class_near(name, cpp))
        if self._is_function_pointer(name):
            return _HELD
        if name in self._open.declared:
            return _UNDEFINED
        if (
            name in self._code.macros
            or name in self._open.defined
            or is_known(call)
            or name in OF_C
        ):
            return None
        if around is not None and not name.isupper() and self._open.unread_bases(around):
            return _INHERITED if self._is_plain(name) else None
        return None

    def _is_function_pointer(self, name: str) -> bool:
        """Whether something of a name is declared as `void (*name)(int)`, or with `&`."""
        for _, place in self._texts.everywhere(name):
            star = place.parent
            around = star.parent if star is not None else None
            if star is None or around is None or around.parent is None:
                continue
            if star.type in _LEADING and around.type == "parenthesized_declarator":
                return around.parent.type == "function_declarator"
            if star.type == "pointer_expression" and around.type == "argument_list":
                # `void (*name)();` outside of a function, which the grammar takes for a call.
                function = around.parent.child_by_field_name("function")
                if function is not None and function.type == "primitive_type":
                    return True
        return False

    def _is_plain(self, name: str) -> bool:
        """Whether a name is none that the tables of libraries have."""
        known = (libraries.node_methods(), libraries.looking(), libraries.keeping_arguments())
        return not self.is_type(name) and not any(name in names for names in known)

    def is_type(self, name: str) -> bool:
        """Whether a name is used as that of a type, where no call could stand."""
        return name in self._code.all_classes or any(
            place.type in _TYPE_NAMES and not _is_called(place)
            for _, place in self._texts.everywhere(name)
        )

    def _of_scope(self, cpp: Cpp, scope: str, name: str, call: CppCall) -> str | None:
        if is_library(f"{scope}::{name}"):
            return None if name in _KEEPING else self._of_library(cpp, call)
        owner = self._texts.class_near(scope.partition("<")[0].rpartition("::")[2], cpp)
        if owner is not None:
            return self._of_class(owner, name, Provenance.MADE)
        around = self._texts.class_of(self._texts.function_around(cpp, call.node))
        last = scope.rpartition("::")[2]
        if around is not None and last in self._open.unread_bases(around):
            return _INHERITED if self._is_plain(name) else None
        return _UNDEFINED if name in self._open.declared else None

    def _of_library(self, cpp: Cpp, call: CppCall) -> str | None:
        """Why a function of a library may: it calls what it gets, and operators of elements."""
        for argument in call.arguments:
            if self._is_held(cpp, argument):
                return _HELD
            if (why := self.of_handed(cpp, argument)) is not None:
                return why
        types = [self._statics.of(cpp, a) for a in call.arguments]
        return self._parts.of_elements(types) or self._parts.of_operands(types)

    def _is_held(self, cpp: Cpp, argument: Node) -> bool:
        """Whether an argument holds a function, which `std::invoke` and algorithms call."""
        if argument.type == "identifier" and self._is_function_pointer(text_of(argument)):
            return True
        type_ = self._statics.of(cpp, argument)
        return type_ is not None and not type_.pointers and type_.last in _CALLED

    def _variable(self, cpp: Cpp, node: Node, variable: Variable) -> str | None:
        given = made_of(variable.name) if variable.kind == "local" else None
        if given and given[0].type == "lambda_expression":
            return None  # whose body stands there
        type_ = self._statics.declared(variable)
        if type_ is not None and not type_.pointers:
            owner = self._statics.class_of(type_)
            if owner is not None and not is_library(type_.name):
                return self._of_class(owner, "operator()", Provenance.MADE)
            is_object = "::" in type_.name or bool(type_.arguments)
            if is_object and type_.last not in _CALLED:
                return None  # an object of a library
        return None if is_matrix(text_of(variable.type or node)) else _HELD

    def _held(self, cpp: Cpp, node: Node) -> str | None:
        """`fns_[0]()`, `(*f)()`, `(this->*f)()`."""
        if node.type in ("lambda_expression", "template_type", "dependent_name"):
            return None
        type_ = self._statics.of(cpp, node)
        owner = self._statics.class_of(type_)
        if owner is not None:
            return self._of_class(owner, "operator()", Provenance.MADE)
        is_object = type_ is not None and not type_.pointers and type_.last not in _CALLED
        return None if is_object else _HELD

    # --- methods --------------------------------------------------------------------------------

    def _method(self, cpp: Cpp, call: CppCall) -> str | None:
        assert call.target is not None
        function = part(call.node, "function")
        name = unscoped_member(part(function, "field")).rpartition("::")[2]
        type_ = self._statics.of(cpp, call.target)
        if type_ is not None and is_arrow(function):
            type_ = self._statics.dereferenced(type_)
        if call.target.type == "this":
            around = self._texts.class_of(self._texts.function_around(cpp, call.node))
            return self._of_class(around, name, Provenance.MADE) if around is not None else None
        if type_ is None:
            return self._by_name(name)
        if name in ("first", "second") and type_.last == "pair":
            return self._held(cpp, function)
        if type_.pointers or is_library(type_.name):
            is_looking = name in _COUNTING
            elements = None if is_looking else self._parts.of_elements([type_])
            return self._held_object(type_, name) or elements
        if "::" in type_.name and self._open.is_forward(type_.name):
            return _UNDEFINED
        owner = self._statics.class_of(type_)
        if owner is not None:
            return self._of_class(owner, name, self._made(cpp, call.target, function))
        if type_.last in self._open.forward:
            return _UNDEFINED
        if name in libraries.looking():
            return None
        is_given = self._provenance.of(cpp, call.target) is Provenance.GIVEN
        return _GIVEN if is_given else None

    def _made(self, cpp: Cpp, target: Node, function: Node) -> Provenance:
        """Where the object that a method is called of comes from."""
        if is_arrow(function):
            return self._provenance.led_to(cpp, target, "operator->")
        return self._provenance.of(cpp, target)

    def _held_object(self, type_: StaticType, name: str) -> str | None:
        """Why a pointer or a container may, that makes or ends what it holds."""
        if name == "reset" and type_.last in POINTING and type_.arguments:
            held = self._statics.written(type_.cpp, type_.arguments[0])
            return self._parts.of_object(held, is_held=True)
        return self._parts.of_object(type_) if name in _MAKING and not type_.pointers else None

    def _by_name(self, name: str) -> str | None:
        """Of an object whose class is not known: whether a class has such a method, unread."""
        return _UNDEFINED if name in self._open.undefined else None

    def _of_class(self, owner: CppClass, name: str, made: Provenance) -> str | None:
        for class_ in self._texts.lineage(owner):
            if (member := self._types.member(class_, name)) is not None:
                return self._member(member)
            declared = [f for f in class_.functions if f.name == name]
            if not declared:
                if any(f.name == f"(*{name})" for f in class_.functions):
                    return _HELD
                continue
            below = [
                b for c in self._texts.descendants(class_) for b in self._calls.bodies(c, name)
            ]
            above = [f for c in self._texts.lineage(class_) for f in c.functions if f.name == name]
            if self._open.lacks_body(class_, name):
                is_read = bool(below) and made is Provenance.MADE
                return None if is_read and _is_virtual(above) else _UNDEFINED
            if _is_virtual(above):
                others = self._texts.descendants(class_)
                if any(self._open.lacks_override(each, name) for each in others):
                    return _UNDEFINED
            if _is_virtual(above) and made is not Provenance.MADE:
                return _OVERRIDDEN
            return None
        return _INHERITED if self._open.unread_bases(owner) else None

    def _member(self, member: Variable) -> str | None:
        """A function that is a member variable of an object."""
        type_ = self._statics.declared(member)
        is_object = type_ is not None and not type_.pointers and type_.last not in _CALLED
        return None if is_object else _HELD

    def _declares(self, owner: CppClass, name: str) -> bool:
        of_class = (f.name for c in self._texts.lineage(owner) for f in c.functions)
        return any(each in (name, f"(*{name})") for each in of_class)


def _is_called(place: Node) -> bool:
    """Whether a name may be called, though the grammar takes it for a type: `T x(name());`."""
    above = place.parent
    while above is not None and above.type in _NAMING:
        above = above.parent
    around = above.child_by_field_name("declarator") if above is not None else None
    return around is not None and around.type == "abstract_function_declarator"


def _is_virtual(functions: list[CppFunction]) -> bool:
    return any(f.pure or f.overrides or text_of(f.node).startswith("virtual") for f in functions)


def _is_address(node: Node) -> bool:
    return node.type == "pointer_expression" and node.children[0].type == "&"
