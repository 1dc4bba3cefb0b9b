"""Operators that programs give enumerations ([over.oper]): the model's are those of numbers."""

from __future__ import annotations

from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_implicit_calls import LITERALS, OPERATORS, operators
from rebsync.reverse.bodies.effects.cpp_undefined import Undefined, is_library
from rebsync.reverse.bodies.effects.known_functions import type_takes_values
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, part, text_of
from rebsync.reverse.values.cpp_static_types import StaticTypes

# Expressions with an operator that may be one of an enumeration, and that the model has.
_SIGNED = frozenset(
    {"binary_expression", "unary_expression", "update_expression", "assignment_expression"}
)
_SIZED = ("unsigned", "signed", "long", "short")


class EnumOperators:
    """Which operators in some code may be the program's own, of an enumeration."""

    def __init__(self, statics: StaticTypes, open_: Undefined) -> None:
        self._statics = statics
        self._open = open_

    def why(self, cpp: Cpp, node: Node) -> str | None:
        """Why an operator may do something else than that of numbers; None for all others."""
        if not self._names or node.type not in _SIGNED:
            return None
        if self._names.isdisjoint(operators(node)):
            return None
        operands = [part(node, each) for each in self._operands(node)]
        if all(self._is_plain(cpp, operand) for operand in operands):
            return None
        return f'the program has an "operator{_sign(node)}" of its own for an enumeration'

    @cached_property
    def _names(self) -> frozenset[str]:
        """The operators outside of classes that may take an enumeration."""
        found = [f for each in self._open.bodies.values() for f in each if not f.owner]
        taking = (f.name for f in found if f.name.startswith("operator") and self._may_take(f))
        unread = (n for n in self._open.declared if n.startswith("operator"))
        return frozenset(taking).union(unread)

    def _may_take(self, function: CppFunction) -> bool:
        """Whether each parameter may be one, or a number beside one: none is of a class."""
        types = (self._statics.written(function.cpp, p.type) for p in function.parameters)
        return all(
            t is None or (self._statics.class_of(t) is None and not is_library(t.name))
            for t in types
        )

    def _operands(self, node: Node) -> tuple[str, ...]:
        both = node.type == "assignment_expression"
        return ("left", "right") if both else OPERATORS[node.type]

    def _is_plain(self, cpp: Cpp, node: Node) -> bool:
        """Whether the value of an expression is surely a number, a text, or of a message."""
        if node.type in LITERALS:
            return True
        if node.type == "parenthesized_expression":
            return all(self._is_plain(cpp, each) for each in node.named_children)
        if node.type in ("binary_expression", "unary_expression", "update_expression"):
            return self.why(cpp, node) is None
        type_ = self._statics.of(cpp, node)
        if type_ is None and node.type == "field_expression":
            type_ = self._statics.of(cpp, part(node, "argument"))
            return type_ is not None and is_library(type_.name)
        return type_ is not None and (
            type_takes_values(type_.name) or type_.name.startswith(_SIZED)
        )


def _sign(node: Node) -> str:
    return text_of(node.child_by_field_name("operator") or node.children[0])
