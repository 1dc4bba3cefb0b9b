"""What a node of a C++ tree stands in."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, part, text_of
from rebsync.reverse.syntax.descendants import nodes_in


def enclosing_function(node: Node, functions: Sequence[CppFunction]) -> CppFunction | None:
    """The function that a lambda stands in."""
    bodies = {f.body.id: f for f in functions if f.body is not None}
    return next((bodies[n.id] for n in (node, *ancestors(node)) if n.id in bodies), None)


def locals_referred_to(lambda_: Node, function: CppFunction) -> set[str]:
    """The locals and parameters of a function that a lambda in it captures by reference.

    They are gone where the lambda is called after the function has returned.
    """
    referred, copied, before = set[str](), set[str](), ""
    for capture in part(lambda_, "captures").children:
        text = text_of(capture)
        if capture.type in ("identifier", "lambda_capture_initializer"):
            by_reference = "&" in before + text
            (referred if by_reference else copied).update(_names_in(capture))
        elif capture.type == "lambda_default_capture" and text == "&":
            referred |= _names_in(part(lambda_, "body"))
        before = text
    return locals_of(function) & (referred - copied)


def locals_of(function: CppFunction) -> set[str]:
    """The names of locals and parameters of a function."""
    declared = inside(function.body, "declaration", "init_declarator", "for_range_loop")
    declarators = [d for n in declared for d in n.children_by_field_name("declarator")]
    names = {name for d in declarators if d.type != "init_declarator" for name in _names_in(d)}
    return names | {p.name for p in function.parameters}


def _names_in(node: Node) -> set[str]:
    return {text_of(n) for n in nodes_in(node) if n.type == "identifier"}


def enclosing_statement(node: Node) -> Node | None:
    """The statement, or entry of an initialiser list, that a node is in."""
    for at in (node, *ancestors(node)):
        if at.type.endswith("_statement") or at.type in ("declaration", "field_initializer"):
            return at
        if at.type in ("function_definition", "lambda_expression"):
            return None
    return None


def in_lambda(node: Node) -> bool:
    """Whether a node is in a function without a name, which others call."""
    return any(n.type == "lambda_expression" for n in ancestors(node))
