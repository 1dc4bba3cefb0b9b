"""The calls in a piece of C++: what is called, on what, with which types and arguments."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, part, text_of


@dataclass(frozen=True, slots=True)
class CppCall:
    """`target.name<types>(arguments)`; `target` is None for a plain function."""

    name: str
    target: Node | None
    types: tuple[Node, ...]
    arguments: tuple[Node, ...]
    node: Node

    @property
    def on(self) -> str:
        """The text of the target, without `this->`."""
        return text_of(self.target).removeprefix("this->") if self.target is not None else ""


def name_called(cpp: Cpp, call: Node) -> str:
    """The last name of what a node of a call calls."""
    function = part(call, "function")
    kind = function.type
    if kind == "identifier":
        return cpp.text(function)
    if kind == "field_expression":
        function = part(function, "field")
        kind = function.type
    if kind in ("template_function", "template_method"):
        function = part(function, "name")
    return cpp.text(function).rpartition("::")[2]


def call_of(node: Node) -> CppCall | None:
    """The call that a node is, if it is one."""
    if node.type != "call_expression":
        return None
    function = part(node, "function")
    target: Node | None = None
    types: tuple[Node, ...] = ()
    if function.type == "field_expression":
        target, function = part(function, "argument"), part(function, "field")
    if function.type in ("template_function", "template_method"):
        types = tuple(named(part(function, "arguments")))
        function = part(function, "name")
    arguments = tuple(named(part(node, "arguments")))
    return CppCall(text_of(function), target, types, arguments, node)


def calls_in(node: Node | None) -> Iterator[CppCall]:
    """All calls in a node, outer ones first, in the order of the text."""
    for current in inside(node, "call_expression"):
        if (call := call_of(current)) is not None:
            yield call


def string_of(node: Node) -> str | None:
    """The text that a literal stands for, pieces that follow each other joined."""
    if node.type == "concatenated_string":
        pieces = [string_of(c) for c in named(node)]
        return None if None in pieces else "".join(p for p in pieces if p is not None)
    if node.type != "string_literal":
        return None
    text = text_of(node)
    return text[1:-1] if text.startswith('"') else None


def assigned_in(body: Node | None) -> Iterator[tuple[str, Node]]:
    """`name = value;` for the statements of a body itself, not of those within.

    What is written `this->name` counts as `name`.
    """
    for statement in named(body) if body is not None else []:
        if statement.type != "expression_statement":
            continue
        for expression in named(statement):
            if expression.type == "assignment_expression":
                left = text_of(part(expression, "left")).removeprefix("this->")
                yield left, part(expression, "right")


def call_around(node: Node) -> Node | None:
    """The innermost call that a node is a part of, within its statement."""
    call = climb(node, lambda n: n.type in ("call_expression", "compound_statement"))
    return call if call is not None and call.type == "call_expression" else None
