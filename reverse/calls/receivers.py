"""Calls on objects of which no file tells the class: what their names and arguments say alone."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.libraries.routines import Kind, Routine
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_values import Values

_TEXTS = frozenset({"string_literal", "concatenated_string", "raw_string_literal"})
# Methods whose names say enough, and those that need a name of a parameter beside them.
_MAKING = frozenset({Kind.PUBLISHER, Kind.SUBSCRIPTION, Kind.TIMER, Kind.SERVICE, Kind.CLIENT})
_OF_PARAMETERS = frozenset({Kind.PARAMETER, Kind.DECLARED, Kind.READ, Kind.SET})


def says_enough(values: Values, cpp: Cpp, ask: Routine, given: tuple[Node, ...]) -> bool:
    """Whether a method of this name with these arguments asks for something, whatever its object.

    Arguments that an object of options stands for say so as well.
    """
    if ask.options is not None and len(given) == 1:
        return values.types.type_of(cpp, given[0]).rpartition("::")[2] == ask.options
    if len(given) < ask.least:
        return False
    return ask.kind in _MAKING or names_parameter(values, cpp, ask, given)


def names_parameter(values: Values, cpp: Cpp, ask: Routine, given: tuple[Node, ...]) -> bool:
    """Whether a method has to do with a parameter: its first argument names one, or several."""
    if ask.kind not in _OF_PARAMETERS or not ask.least <= len(given):
        return False
    first = given[0]
    if ask.kind is Kind.SET:
        return "Parameter" in text_of(first)
    if ask.kind is Kind.READ and first.type == "initializer_list":
        return all(is_text(values, cpp, each) for each in named(first))
    return is_text(values, cpp, first)


def is_text(values: Values, cpp: Cpp, node: Node) -> bool:
    """Whether an expression is a text: a literal, a variable, or texts put together."""
    if node.type == "binary_expression":
        operands = (part(node, "left"), part(node, "right"))
        return any(is_text(values, cpp, each) for each in operands)
    return node.type in _TEXTS or values.types.type_of(cpp, node) in ("std::string", "string")
