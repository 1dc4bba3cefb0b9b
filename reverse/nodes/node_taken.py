"""Which names functions have already, told for one name without a list of all of them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, text_of

_DECLARING = ("declaration", "init_declarator", "for_range_loop", "parameter_declaration")
_NAMES = ("identifier", "field_identifier")
_WORD = re.compile(r"[A-Za-z_0-9]+\Z")


@dataclass(frozen=True)
class UsedNames:
    """The names of some functions and of their parameters, and those that their bodies declare."""

    code: Code
    functions: tuple[CppFunction, ...]

    def __contains__(self, name: object) -> bool:
        if not isinstance(name, str) or name in self._outside:
            return isinstance(name, str)
        bodies = ((f.cpp, f.body) for f in self.functions if f.body is not None)
        return any(declares(self.code, cpp, body, name) for cpp, body in bodies)

    @cached_property
    def _outside(self) -> frozenset[str]:
        parameters = {p.name for f in self.functions for p in f.parameters}
        return frozenset(parameters.union(f.name for f in self.functions))


def declares(code: Code, cpp: Cpp, body: Node, name: str) -> bool:
    """Whether a body declares a variable of a name: whether the name is among those `declared`."""
    return any(map(_is_declared, uses(code, cpp, body, name)))


def uses(code: Code, cpp: Cpp, body: Node, name: str) -> Iterator[Node]:
    """Where a name of a variable or field stands in a body."""
    found = code.named(cpp, body, (name,)) if _WORD.match(name) else inside(body, *_NAMES)
    yield from (node for node in found if node.type in _NAMES and cpp.text(node) == name)


def _is_declared(node: Node) -> bool:
    """Whether a name stands in the declarator of a declaration."""
    if node.type != "identifier":
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
