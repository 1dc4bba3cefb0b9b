"""Statements of generated code that do nothing to a model: what is logged, what only declares."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.bodies.effects.known_functions import logs, takes_values
from rebsync.reverse.generated.ros2_words import ASKS
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.cpp_calls import CppCall, calls_in
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of

_DECLARES = frozenset({"using_declaration", "static_assert_declaration"})
_CHANGES = (
    *("assignment_expression", "update_expression", "new_expression", "delete_expression"),
    *("lambda_expression", "co_await_expression", "ERROR"),
)
# Functions of ROS that only tell of the node and the clock.
_ASKS = frozenset({"now", "getName", "getNamespace", "ok"}) | ASKS


def working(body: Node | None) -> list[Node]:
    """The statements of a body but for those that do nothing to the model."""
    return [s for s in named(body) if not is_idle(s)] if body is not None else []


def is_idle(statement: Node) -> bool:
    """Whether a statement logs, declares a type, or is a semicolon alone."""
    if statement.type != "expression_statement":
        return statement.type in _DECLARES
    expressions = named(statement)
    if not expressions:
        return True
    return _logs(expressions[0]) and _only_looks(expressions[0])


def _logs(node: Node) -> bool:
    """Whether it is `ROS_INFO(...)` or `std::cout << ...`, or says that it is nothing."""
    if node.type == "cast_expression":
        return text_of(part(node, "type")) == "void"
    return text_of(node).startswith("static_cast<void>(") or logs(node)


def _only_looks(node: Node) -> bool:
    """Whether what is logged is only looked at."""
    if inside(node, *_CHANGES):
        return False
    reads = (text_of(part(b, "operator")) == ">>" for b in inside(node, "binary_expression"))
    return not any(reads) and all(_is_look(call) for call in calls_in(node))


def _is_look(call: CppCall) -> bool:
    name = call.name.rpartition("::")[2]
    if name in libraries.acting():
        return False
    if call.target is not None:
        return name in libraries.looking() or name in _ASKS
    return name in _ASKS or call.name == "static_cast" or takes_values(call)
