"""What callbacks hold copies of: captures by value, and arguments of a bind.

The model has one variable for what is copied. It says what the code does as long as nothing
changes that variable after the copy was made.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_roots import identifiers_in
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.syntax.cpp_enclosing import enclosing_function, locals_of
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, part, text_of

_HINT = "capture it by reference, or leave the variable as it is"


def list_changed_copies(unit: Unit, server: Server, within: str, findings: Findings) -> None:
    """Lists copies that the callback of a server holds of variables that change later."""
    for node, name in _copies(unit, server):
        function = enclosing_function(node, unit.functions)
        if function is not None and _changes(unit, function, node, name):
            why = f'"{name}" is copied here and changes later: the model has one variable for both'
            findings.unreadable(
                function.cpp.source, Unread(function.cpp.span(node), why, _HINT), within
            )
            return


def _copies(unit: Unit, server: Server) -> Iterator[tuple[Node, str]]:
    """The names that are copied, each with the place."""
    lambda_ = server.callback.lambda_
    if lambda_ is not None:
        yield from ((lambda_, name) for name in _captured(unit, lambda_))
    for _, bound in server.arguments:
        if _is_reference(bound):
            continue
        yield from ((bound, text_of(n)) for n in (bound, *identifiers_in(bound)) if _is_name(n))


def _captured(unit: Unit, lambda_: Node) -> Iterator[str]:
    captures = part(lambda_, "captures")
    texts = [text_of(child) for child in captures.children]
    for before, child in zip(["", *texts], captures.children, strict=False):
        if child.type == "identifier" and before != "&":
            yield text_of(child)
    if "=" in texts:
        function = enclosing_function(lambda_, unit.functions)
        used = {text_of(n) for n in identifiers_in(part(lambda_, "body"))}
        yield from sorted(used & (locals_of(function) if function is not None else set()))


def _is_name(node: Node) -> bool:
    return node.type in ("identifier", "field_identifier")


def _is_reference(bound: Node) -> bool:
    """`std::ref(x)`, `&x` and `this`: no copy of what is behind."""
    called = text_of(bound).partition("(")[0]
    return bound.type in ("pointer_expression", "this") or called.endswith("ref")


def _changes(unit: Unit, function: CppFunction, at: Node, name: str) -> bool:
    """Whether a variable may get another value after a place: a local there, a member anywhere."""
    is_local = name in locals_of(function)
    for other in unit.functions if not is_local else (function,):
        if other.body is None:
            continue
        for node in inside(other.body, "assignment_expression", "update_expression"):
            target = node.child_by_field_name("left") or node.child_by_field_name("argument")
            later = other is not function or node.start_byte > at.start_byte
            if target is not None and later and _base(target) == name:
                return True
    return False


def _base(target: Node) -> str:
    """The variable that a place belongs to: `a` of `this->a.b[0]`."""
    plain = text_of(target).removeprefix("this->").removeprefix("(*this).")
    return plain.partition("[")[0].partition(".")[0].partition("->")[0].strip()
