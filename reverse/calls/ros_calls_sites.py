"""Where code asks ROS for something, and where it keeps what it is given."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.graph import Site
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, part, text_of
from rebsync.reverse.values.cpp_flow import FIXTURES
from rebsync.reverse.values.cpp_flow_types import unscoped_member
from rebsync.reverse.values.cpp_values import Values
from rebsync.reverse.values.cpp_values_plain import at

_TESTS = FIXTURES | {"TEST"}


def site_of(values: Values, cpp: Cpp, place: Node, call: Node) -> Site:
    """The site of a call whose function's name stands at a place."""
    function = values.texts.function_around(cpp, place)
    return Site(owner_of(function), function, cpp, call, at(cpp, place), kept(call))


def owner_of(function: CppFunction | None) -> str | None:
    """The class that a function is of; its own name outside of classes."""
    owner = (function.owner or function.name) if function is not None else None
    return None if owner in _TESTS else owner  # there is no function of that name


def kept(call: Node) -> str:
    """The expression in which the code keeps what a call gives."""
    node, above = call, call.parent
    while above is not None and above.type in (
        "parenthesized_expression",
        "conditional_expression",
    ):
        node, above = above, above.parent
    if above is None:
        return ""
    match above.type:
        case "assignment_expression" if part(above, "right") == node:
            return text_of(part(above, "left"))
        case "init_declarator":
            return text_of(part(above, "declarator")).lstrip("*& ")
        case "argument_list" if above.parent is not None:
            return _kept_by(above.parent)
        case _:
            return ""


def _kept_by(holder: Node) -> str:
    if holder.type == "field_initializer":
        return text_of(holder.named_children[0])
    if holder.type == "init_declarator":
        return text_of(part(holder, "declarator")).lstrip("*& ")
    if holder.type == "new_expression":
        return kept(holder)
    if holder.type == "call_expression":
        function = part(holder, "function")
        name = text_of(function).partition("<")[0].rpartition("::")[2]
        if function.type == "field_expression":
            field = unscoped_member(part(function, "field"))
            if field in ("push_back", "emplace_back", "reset"):
                return text_of(part(function, "argument"))
        if name in ("make_shared", "make_unique"):
            return kept(holder)
    return ""
