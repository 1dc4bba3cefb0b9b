"""What a package uses of the files that it takes of other packages of the workspace.

These declare more than the package uses. What its own files name is used, and what that names in
its turn: classes with all their functions, free functions, and whatever a file does besides.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import TypeVar

from tree_sitter import Node

from rebsync.reverse.graph import Fact, UnmodelledFact
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of

F = TypeVar("F", bound="Fact | UnmodelledFact")

_WORD = re.compile(rb"[A-Za-z_]\w*")
_CLASSES = frozenset({"class_specifier", "struct_specifier", "class_definition"})
_DEFINED = _CLASSES | {"function_definition"}
_AROUND = frozenset(
    {
        *("translation_unit", "module", "namespace_definition", "declaration_list"),
        *("linkage_specification", "template_declaration", "decorated_definition"),
        *("preproc_ifdef", "preproc_if", "preproc_else", "preproc_elif"),
    }
)


def used_names(files: Sequence[Cpp]) -> frozenset[bytes]:
    """The names that own files use, and those that what is used of other packages does."""
    beside = [each for each in files if each.is_beside]
    found = frozenset[bytes]().union(*(each.words for each in files if not each.is_beside))
    if not beside:
        return found
    by_name: dict[bytes, list[Node]] = {}
    names = set(found)
    for each in beside:
        for node in _parts(each.root):
            if node.type in _DEFINED:
                by_name.setdefault(_name(node), []).append(node)
            else:
                names |= _words(node)
    waiting = [name for name in by_name if name in names]
    while waiting:
        for node in by_name.pop(waiting.pop(), ()):
            fresh = _words(node) - names
            names |= fresh
            waiting += (name for name in fresh if name in by_name)
    return frozenset(names)


def without_unused(facts: Iterable[F], files: Sequence[Cpp]) -> Iterator[F]:
    """The facts but for those of classes and functions of other packages that nothing uses."""
    used = used_names(files) if any(each.is_beside for each in files) else frozenset[bytes]()
    for fact in facts:
        owner = fact.site.owner
        if owner is None or not fact.site.cpp.is_beside or owner.encode() in used:
            yield fact


def _parts(root: Node) -> Iterator[Node]:
    """What a file consists of, definitions and the rest, within namespaces and conditions too."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if node.type in _AROUND:
            waiting += reversed(node.named_children)
        else:
            yield node


def _name(node: Node) -> bytes:
    """The name of a class, or of the class of a member function, or of a free function."""
    if node.type in _CLASSES or node.child_by_field_name("name") is not None:
        name = node.child_by_field_name("name")
        return text_of(name).encode() if name is not None else b""
    declarator = node.child_by_field_name("declarator")
    while declarator is not None and declarator.type not in ("identifier", "qualified_identifier"):
        inner = declarator.child_by_field_name("declarator")
        declarator = inner if inner is not None else _first_name(declarator)
    parts = text_of(declarator).split("::") if declarator is not None else [""]
    return parts[-2 if len(parts) > 1 else 0].partition("<")[0].strip().encode()


def _first_name(declarator: Node) -> Node | None:
    """The name in a declarator that has it behind `&`."""
    named = ("identifier", "qualified_identifier", "function_declarator", "operator_name")
    return next((c for c in declarator.named_children if c.type in named), None)


def _words(node: Node) -> set[bytes]:
    return set(_WORD.findall(node.text or b""))
