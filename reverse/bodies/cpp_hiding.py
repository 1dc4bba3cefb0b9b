"""Declarations in bodies that hide what the model has, though they make no variable.

An enumeration, a class, a type, a function or what stands elsewhere has the name from there on
([basic.scope.hiding]): `enum { cell_ = 5 };`. And what looks like a conversion is a declaration
where it can be one ([stmt.ambig]): `bool(loaded_) = true;` makes a local of that name.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reserved import RESERVED
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.syntax.cpp_declarations import unscoped
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of

_TYPES = ("class_specifier", "struct_specifier", "union_specifier", "enum_specifier")
_NAMED = {"alias_declaration": "name", "type_definition": "declarator"}
_FUNCTION = "function_declarator"


def check_hiding(reader: CppStatementReader, node: Node) -> None:
    """Raises `Unread` where a statement hides what the scope has, by what is no variable."""
    scope = reader.scope
    if node.type == "using_declaration" and text_of(named(node)[-1]).startswith("std::"):
        return  # by which names mean what they are taken for
    for name in names_given(node):
        known = scope.meaning(name) is not None or name in scope.functions
        if known or name in scope.members or name in scope.constants or name in RESERVED:
            raise reader.unread(node, f'from here on "{name}" is what this declares')


def names_given(node: Node) -> Iterator[str]:
    """The names that a statement gives to what is no variable, or not written as one."""
    kind = node.type
    if kind == "expression_statement":
        yield from _converted(node)
    if (field := _NAMED.get(kind)) is not None and (name := node.child_by_field_name(field)):
        yield text_of(name)
    if kind == "using_declaration" and named(node) and b"namespace" not in _words(node):
        yield unscoped(named(node)[-1])
    type_ = node if kind in _TYPES else node.child_by_field_name("type")
    if type_ is not None and type_.type in _TYPES:
        name = type_.child_by_field_name("name")
        yield from [unscoped(name)] if name is not None else []
        if type_.type == "enum_specifier":
            yield from (text_of(part(n, "name")) for n in inside(type_, "enumerator"))
    if kind == "declaration":
        is_elsewhere = b"extern" in _words(node)
        for each in node.children_by_field_name("declarator"):
            if is_elsewhere or each.type == _FUNCTION:
                yield from (text_of(n) for n in inside(each, "identifier")[:1])


def _words(node: Node) -> set[bytes | None]:
    return {child.text for child in node.children}


def _converted(node: Node) -> Iterator[str]:
    """The variable that `type(name)` declares at the beginning of a statement."""
    first = next(iter(named(node)), None)
    while first is not None and first.type == "assignment_expression":
        first = part(first, "left")
    if first is None or first.type != "call_expression":
        return
    given = named(part(first, "arguments"))
    is_type = part(first, "function").type in ("primitive_type", "sized_type_specifier")
    if is_type and len(given) == 1 and given[0].type == "identifier":
        yield text_of(given[0])
