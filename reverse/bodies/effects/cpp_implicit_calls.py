"""Calls that C++ makes where none is written: conversions, temporaries, defaults, literals.

They run functions of the files as calls do, and so may run what was not read: conversion functions
and converting constructors ([class.conv]), what begins and ends the life of what a call takes and
gives by value ([class.temporary]), default arguments ([dcl.fct.default]), literal operators
([over.literal]), and functions for memory ([class.free]).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cached_property
from weakref import WeakMethod

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_object_parts import UNDEFINED, ObjectParts
from rebsync.reverse.bodies.effects.cpp_undefined import ALLOCATING, Undefined
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_declarations import CppFunction, CppParameter
from rebsync.reverse.syntax.cpp_index import CppClass
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_flow import Texts
from rebsync.reverse.values.cpp_flow_calls import Calls
from rebsync.reverse.values.cpp_static_types import StaticType, StaticTypes

# What may be a call of an operator, with the operands whose class says which.
OPERATORS = {
    "binary_expression": ("left", "right"),
    "assignment_expression": ("left",),
    "update_expression": ("argument",),
    "unary_expression": ("argument",),
    "pointer_expression": ("argument",),
    "subscript_expression": ("argument",),
    "field_expression": ("argument",),
    "comma_expression": ("left", "right"),
}
_SIGNS = {"subscript_expression": "[]", "field_expression": "->", "comma_expression": ","}
# By which operators others are rewritten ([over.match.oper]).
_REWRITTEN = {"!=": "==", **dict.fromkeys(("<", ">", "<=", ">="), "<=>")}
COMPARING = frozenset(f"operator{sign}" for sign in ("==", "<=>", *_REWRITTEN))
_NAMED = frozenset({"identifier", "field_expression"})
LITERALS = frozenset(
    {"number_literal", "char_literal", "string_literal", "true", "false", "null", "nullptr"}
)
OfClass = Callable[[CppClass, str], "str | None"]
# What may be an object that is converted, by what it stands for.
_OBJECTS = frozenset(
    {"identifier", "field_expression", "call_expression", "subscript_expression"}
    | {"pointer_expression", "conditional_expression", "compound_literal_expression"}
)
IMPLICIT = _OBJECTS | {"user_defined_literal", "new_expression", "delete_expression"}
# Where an object is used as what it is, by the field of what stands around it.
_AS_IT_IS = {
    "field_expression": ("argument",),
    "call_expression": ("function",),
    "assignment_expression": ("left",),
    "init_declarator": ("declarator",),
    "for_range_loop": ("right", "declarator"),
    "update_expression": ("argument",),
}


class UnwrittenCalls:
    """Why what stands at some place may run what was not read though no call of it stands there."""

    def __init__(
        self,
        texts: Texts,
        statics: StaticTypes,
        calls: Calls,
        parts: ObjectParts,
        of_class: OfClass,
    ) -> None:
        self._texts = texts
        self._statics = statics
        self._calls = calls
        self._parts = parts
        self._open: Undefined = parts.open
        self._of_class = WeakMethod(of_class)  # of the object that has this one

    def of(self, cpp: Cpp, node: Node) -> str | None:
        """Why an expression may: as it makes an object, or as its value is converted."""
        match node.type:
            case "user_defined_literal":
                return self._literal(node)
            case "compound_literal_expression":
                made = self._parts.of_object(self._statics.written(cpp, part(node, "type")))
                return made or self._converted(cpp, node)
            case "new_expression" | "delete_expression":
                return UNDEFINED if ALLOCATING & self._open.declared else None
            case _:
                return self._converted(cpp, node)

    def defaults(self, cpp: Cpp, call: CppCall) -> Iterator[tuple[Cpp, Node]]:
        """What a call evaluates for parameters that it gives no arguments for."""
        for function in self._calls.functions(cpp, call.node):
            for index in range(len(call.arguments), len(function.parameters)):
                if (default := self._calls.default(function, index)) is not None:
                    yield default

        yield from self.made_with(self._statics.of(cpp, call.node) if self._makes(call) else None)

    def _makes(self, call: CppCall) -> bool:
        """Whether a call makes an object by the name of its class."""
        name = call.name.partition("<")[0].rpartition("::")[2]
        return name in self._texts.code.all_classes or name.startswith("make_")

    def made_with(self, type_: StaticType | None) -> Iterator[tuple[Cpp, Node]]:
        """What is evaluated to make an object of a type: of members, and for parameters."""
        owner = self._statics.class_of(replace(type_, pointers=0) if type_ else None)
        for class_ in self._parts.within(owner) if owner is not None else ():
            for each in (*class_.fields, *class_.others):
                if each.value is not None:
                    yield each.cpp, each.value
            for function in class_.functions if owner is not None else ():
                for parameter in function.parameters if function.name == class_.name else ():
                    default = parameter.node.child_by_field_name("default_value")
                    if default is not None:
                        yield function.cpp, default

    def free_functions(self, cpp: Cpp, node: Node) -> list[CppFunction]:
        """The functions outside of classes that an operator or a literal may run, with bodies."""
        if node.type == "user_defined_literal":
            return self._open.bodies.get(f'operator""{text_of(named(node)[-1])}', [])
        fields = OPERATORS.get(node.type, ())
        names = operators(node) if fields else ()
        found = [f for name in names for f in self._open.bodies.get(name, ())]
        operands = [part(node, each) for each in fields]
        return [f for f in found if not f.owner and self._may_take(f, cpp, operands)]

    def _may_take(self, function: CppFunction, cpp: Cpp, operands: list[Node]) -> bool:
        """Whether a function may take some operands, as far as classes of the files tell."""
        if len(function.parameters) != len(operands) or all(n.type in LITERALS for n in operands):
            return False
        for parameter, operand in zip(function.parameters, operands, strict=True):
            taken = self._statics.written(function.cpp, parameter.type)
            given = self._statics.of(cpp, operand)
            if taken is not None and taken.last.endswith("stream"):
                continue
            if given is None and operand.type not in _NAMED and not self._is_plain(operand, taken):
                return False
            if given is not None and taken is not None and not self._fits(given, taken):
                return False
        return True

    def _is_plain(self, operand: Node, taken: StaticType | None) -> bool:
        """Whether an operand may be a literal or an enumerator, and is taken for what it is."""
        if operand.type not in LITERALS | {"qualified_identifier"}:
            return False
        return taken is None or not (taken.arguments or self._statics.class_of(taken))

    def _fits(self, given: StaticType, taken: StaticType) -> bool:
        owner, of = self._statics.class_of(given), self._statics.class_of(taken)
        if of is None:
            return given.last == taken.last
        return owner is not None and self._descends(owner, of)

    def of_call(self, cpp: Cpp, call: CppCall) -> str | None:
        """Why to make what a call takes and gives may."""
        if not self._open.has_undefined:
            return None
        for function in self._calls.functions(cpp, call.node):
            result = None if function.gives_place else self._statics.given(function)
            if (why := self._parts.of_object(result)) is not None:
                return why
            for parameter, argument in zip(function.parameters, call.arguments, strict=False):
                if (why := self._passed(cpp, function, parameter, argument)) is not None:
                    return why
        return None

    def _passed(
        self, cpp: Cpp, function: CppFunction, parameter: CppParameter, argument: Node
    ) -> str | None:
        """Why to make an object of a parameter may: a reference is to an object of its class."""
        text = text_of(parameter.node).partition("=")[0]
        type_ = self._statics.written(function.cpp, parameter.type)
        if type_ is None or "*" in text:
            return None
        if "&" in text:
            owner = self._statics.class_of(self._statics.of(cpp, argument))
            of = self._statics.class_of(type_)
            if owner is not None and of is not None and self._descends(owner, of):
                return None
        return self._parts.of_object(type_)

    # --- literals and conversions ---------------------------------------------------------------

    def _literal(self, node: Node) -> str | None:
        suffix = text_of(named(node)[-1])
        return UNDEFINED if f'operator""{suffix}' in self._open.declared else None

    @property
    def may_convert(self) -> bool:
        """Whether some object may be converted, or made, by what was not read."""
        return bool(self._conversions) or self._open.has_undefined

    @cached_property
    def _conversions(self) -> frozenset[str]:
        """The conversion functions that a class has no body of."""
        found = (n for n in self._open.undefined if n.startswith("operator "))
        return frozenset(found) - ALLOCATING

    def _converted(self, cpp: Cpp, node: Node) -> str | None:
        if not self._conversions or _is_as_it_is(node):
            return None
        owner = self._statics.class_of(self._statics.of(cpp, node))
        if owner is None or self._stays(cpp, node, owner):
            return None
        own = {f.name for c in self._texts.lineage(owner) for f in c.functions}
        of_class = self._of_class()
        assert of_class is not None, "who has made this asks"
        found = (of_class(owner, name) for name in sorted(self._conversions & own))
        return next((why for why in found if why is not None), None)

    def _stays(self, cpp: Cpp, node: Node, owner: CppClass) -> bool:
        """Whether what gets an object is of its class, so that nothing converts it."""
        above = node.parent
        while above is not None and above.type == "parenthesized_expression":
            node, above = above, above.parent
        match above:
            case Node(type="init_declarator", parent=Node() as declaration):
                type_ = declaration.child_by_field_name("type")
                is_auto = type_ is not None and type_.type == "placeholder_type_specifier"
                return is_auto or self._is_of(cpp, type_, owner)
            case Node(type="assignment_expression"):
                left = self._statics.class_of(self._statics.of(cpp, part(above, "left")))
                return left is not None and self._descends(owner, left)
            case Node(type="argument_list", parent=Node(type="call_expression") as call):
                place = named(above).index(node)
                taken = [
                    (f.cpp, f.parameters[place].type)
                    for f in self._calls.functions(cpp, call)
                    if place < len(f.parameters)
                ]
                return bool(taken) and all(self._is_of(c, t, owner) for c, t in taken)
            case Node(type="pointer_expression" | "subscript_expression" as kind):
                name = "operator*" if kind == "pointer_expression" else "operator[]"
                is_inside = part(above, "argument") == node
                return is_inside and self._has(owner, name)
            case Node(type="return_statement"):
                function = self._texts.function_around(cpp, node)
                return function is not None and self._is_of(function.cpp, function.result, owner)
            case _:
                return False

    def _has(self, owner: CppClass, name: str) -> bool:
        return any(f.name == name for c in self._texts.lineage(owner) for f in c.functions)

    def _is_of(self, cpp: Cpp, type_: Node | None, owner: CppClass) -> bool:
        of = self._statics.class_of(self._statics.written(cpp, type_))
        return of is not None and self._descends(owner, of)

    def _descends(self, owner: CppClass, of: CppClass) -> bool:
        return any(class_ is of for class_ in self._texts.lineage(owner))


def operators(node: Node) -> frozenset[str]:
    """The names of the operators that an expression may be a call of."""
    sign = text_of(node.child_by_field_name("operator") or node.children[0])
    sign = _SIGNS.get(node.type, sign)
    return frozenset(f"operator{each}" for each in (sign, _REWRITTEN.get(sign)) if each)


def _is_as_it_is(node: Node) -> bool:
    """Whether a place is for an object itself: `x.f()`, `&x`, `x = 3;`, `x;`."""
    above = node.parent
    while above is not None and above.type == "parenthesized_expression":
        node, above = above, above.parent
    if above is None or above.type in ("expression_statement", "lambda_capture_initializer"):
        return True
    if above.type == "pointer_expression" and above.children[0].type == "&":
        return True
    return any(above.child_by_field_name(f) == node for f in _AS_IT_IS.get(above.type, ()))
