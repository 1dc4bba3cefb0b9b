"""The variable that a piece of C++ is, or is part of."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.scope import Itself, Meaning, Outside, Record, Scope, Variable
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.syntax.descendants import nodes_in


def root(scope: Scope, inner: Collection[str], node: Node) -> tuple[str, Meaning | None]:
    """The variable that an expression is, or is part of."""
    match node.type:
        case "identifier":
            name = text_of(node)
            return name, None if name in inner else scope.meaning(name)
        case "field_expression":
            target = part(node, "argument")
            of = root(scope, inner, target)
            if isinstance(of[1], Itself):
                name = text_of(part(node, "field"))
                return name, scope.members.get(name)
            return of
        case "subscript_expression" | "pointer_expression":
            return root(scope, inner, part(node, "argument"))
        case "parenthesized_expression" if len(named(node)) == 1:
            return root(scope, inner, named(node)[0])
        case "qualified_identifier":
            name = text_of(node).rpartition("::")[2]
            return name, scope.members.get(name)
        case "this":
            return "this", Itself()
        case "call_expression":
            target = part(node, "function")
            if target.type == "field_expression":
                return root(scope, inner, target)
            of = root(scope, inner, target) if target.type == "identifier" else ("", None)
            if isinstance(of[1], Outside) and of[1].indexed:
                return of
    return "", None


def is_modelled(node: Node, meaning: Meaning | None) -> bool:
    """Whether a change of the variable is one of the model."""
    match meaning:
        case None | Outside(reaches=False) | m.StringLiteral() | m.IntLiteral():
            return False
        case m.BoolLiteral() | m.FloatLiteral():
            return False
        case Record(fields):
            path = path_in(node)
            return any(p == path or not path or p.startswith(f"{path}.") for p in fields)
        case _:
            return True


def is_number(scope: Scope, inner: Collection[str], node: Node) -> bool:
    """Whether it is a literal or a variable of the model: no object with functions."""
    if node.type in ("parenthesized_expression", "binary_expression"):
        return all(is_number(scope, inner, c) for c in named(node))
    return node.type == "number_literal" or isinstance(root(scope, inner, node)[1], Variable)


def path_in(node: Node) -> str:
    """The path of a field in its message: `linear.x` of `m.linear.x`; empty for all of it."""
    if node.type == "parenthesized_expression" and len(named(node)) == 1:
        return path_in(named(node)[0])
    if node.type == "subscript_expression":
        return path_in(part(node, "argument"))
    if node.type != "field_expression":
        return ""
    target = part(node, "argument")
    if target.type == "this":
        return ""
    before = path_in(target)
    own = text_of(part(node, "field"))
    return f"{before}.{own}" if before else own


def texts_in(node: Node, meaning: Meaning | None) -> frozenset[str]:
    """The variables of texts that a place is, or has in it, by their names in the model."""
    match meaning:
        case Variable(name, type_) if type_ == TEXT:
            return frozenset({name})
        case Record(fields):
            path = path_in(node)
            inner = (
                v for p, v in fields.items() if p == path or not path or p.startswith(f"{path}.")
            )
            return frozenset(v.name for v in inner if v.type == TEXT)
        case _:
            return frozenset()


def identifiers_in(node: Node) -> Iterator[Node]:
    """All names in a place."""
    waiting = [node]
    while waiting:
        current = waiting.pop()
        if current.type == "identifier":
            yield current
        waiting += current.named_children


def declared_in(declarator: Node) -> Iterator[str]:
    """The names that a declarator declares."""
    inside = nodes_in(declarator, "parameter_list")
    return (text_of(n) for n in inside if n.type == "identifier")


def parameters_of(function: Node) -> Iterator[str]:
    """The names of what a lambda gets."""
    declarator = function.child_by_field_name("declarator")
    for parameter in named(part(declarator, "parameters")) if declarator is not None else ():
        for inner in parameter.children_by_field_name("declarator"):
            yield from declared_in(inner)


def specifiers_of(declaration: Node) -> list[str]:
    """The words of a declaration that are short enough to be `static` or `thread_local`."""
    longest = len("thread_local")  # to ask for places is quicker than to ask for all the texts
    children = declaration.named_children
    return [text_of(c) for c in children if c.end_byte - c.start_byte <= longest]


def is_element(node: Node) -> bool:
    """Whether a call gives a part of an array, which may be changed there."""
    call = call_of(node)
    return call is not None and call.name in ("at", "front", "back", "get", "move", "ref")
