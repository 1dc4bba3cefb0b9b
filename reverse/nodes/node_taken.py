"""Which names functions have already, told for one name without a list of all of them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of

_DECLARING = ("declaration", "init_declarator", "for_range_loop", "parameter_declaration")
_WORD = re.compile(r"[A-Za-z_0-9]+\Z")


@dataclass(frozen=True)
class Taken:
    """The names of some functions and of their parameters, and those that their bodies declare."""

    code: Code
    functions: tuple[CppFunction, ...]

    def __contains__(self, name: str) -> bool:
        return name in self._outside or any(
            declares(self.code, f.cpp, f.body, name) for f in self.functions if f.body is not None
        )

    @cached_property
    def _outside(self) -> frozenset[str]:
        parameters = {p.name for f in self.functions for p in f.parameters}
        return frozenset(parameters.union(f.name for f in self.functions))


def declares(code: Code, cpp: Cpp, body: Node, name: str) -> bool:
    """Whether a body declares a variable of a name: whether the name is among those `declared`."""
    if not _WORD.match(name):
        return name in declared(code, cpp, body)
    return any(_is_declared(node, len(name)) for node in code.named(cpp, body, (name,)))


def _is_declared(node: Node, length: int) -> bool:
    """Whether a name, and not a part of a longer one, stands in the declarator of a declaration."""
    if node.type != "identifier" or node.end_byte - node.start_byte != length:
        return False
    at, around = node, node.parent
    while around is not None and around.type not in _DECLARING:
        if not around.type.endswith("declarator"):
            return False
        at, around = around, around.parent
    return around is not None and at in around.children_by_field_name("declarator")


def declared(code: Code, cpp: Cpp, body: Node) -> set[str]:
    """The names of the variables that a body declares."""
    declarators = (
        child
        for node in code.inside(cpp, body, *_DECLARING)
        for child in node.children_by_field_name("declarator")
        if child.type != "init_declarator"  # which is itself among the nodes
    )
    return {text_of(name) for child in declarators for name in _identifiers(child)}


def _identifiers(node: Node) -> Iterator[Node]:
    """The names that a declarator declares, without those of its value."""
    if node.type == "identifier":
        yield node
    elif node.type.endswith("declarator"):
        for child in node.named_children:
            yield from _identifiers(child)
