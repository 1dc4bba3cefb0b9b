"""The type of what a lambda returns that does not write it, where each `return` shows it."""

from __future__ import annotations

from collections.abc import Collection

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_roots import declared_in
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.types.cpp_ranges import COMPARES, INT_BITS, LOGICAL, range_of
from rebsync.reverse.bodies.types.cpp_types import Carried
from rebsync.reverse.syntax.cpp_tree import inside, named, part, returns_in, text_of
from rebsync.static.types import BOOLEAN, INT

_SUMS = frozenset({"+", "-", "*", "/", "%", "&", "|", "^"})


def return_type(reader: CppStatementReader, body: Node) -> Carried | None:
    """The type of all that a body returns; None where one does not show it.

    `reader` knows the names of what is around, and the parameters. C++ wants all of one type.
    """
    own = {
        name
        for node in inside(body, "declaration", "for_range_loop")
        for declarator in node.children_by_field_name("declarator")
        for name in declared_in(declarator)
    }
    values = [value for each in returns_in(body) for value in named(each)]
    types = {_type(reader, value, own) for value in values}
    return types.pop() if len(types) == 1 else None


def _type(reader: CppStatementReader, node: Node, own: Collection[str]) -> Carried | None:
    match node.type:
        case "parenthesized_expression" if len(named(node)) == 1:
            return _type(reader, named(node)[0], own)
        case "true" | "false":
            return Carried(BOOLEAN)
        case "unary_expression" if text_of(part(node, "operator")) in LOGICAL:
            return Carried(BOOLEAN)
        case "binary_expression" if text_of(part(node, "operator")) in COMPARES | LOGICAL:
            return Carried(BOOLEAN)
        case "identifier" if text_of(node) not in own:
            return _of_variable(reader, text_of(node))
        case "number_literal":
            return _whole(reader, node)
        case "unary_expression" | "binary_expression":
            names = {text_of(n) for n in inside(node, "identifier")}
            plain = text_of(part(node, "operator")) in _SUMS and names.isdisjoint(own)
            return _whole(reader, node) if plain else None
        case _:
            return None


def _of_variable(reader: CppStatementReader, name: str) -> Carried | None:
    match reader.scope.meaning(name):
        case Variable(type=type_) as found if type_ is not None and not type_.dimensions:
            return Carried(type_, found.bits, "", found.wide)
        case _:
            return None


def _whole(reader: CppStatementReader, node: Node) -> Carried | None:
    """An `int`, to which C++ also converts the operands of sums that are narrower."""
    found = range_of(reader.cpp, reader.scope, node)
    return Carried(INT) if found is not None and found.bits == INT_BITS else None
