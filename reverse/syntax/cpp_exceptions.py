"""What functions of C++ say of the exceptions that leave them."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.syntax.cpp_tree import named


def is_noexcept(node: Node, implied: bool = False) -> bool:
    """Whether what throws in a function ends the program ([except.spec])."""
    declarator = node.child_by_field_name("declarator")
    while declarator is not None and not declarator.type.endswith("function_declarator"):
        declarator = declarator.child_by_field_name("declarator") or next(
            (c for c in named(declarator) if c.type.endswith("declarator")), None
        )
    for each in named(declarator) if declarator is not None else ():
        if each.type == "noexcept":
            return not any(inner.type == "false" for inner in named(each))
        if each.type == "throw_specifier":
            return not named(each)
    return implied
