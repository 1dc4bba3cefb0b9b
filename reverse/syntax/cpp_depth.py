"""Pieces of C++ that nest deeper than rebsync reads: found in a tree, and taken out of the text."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TypeAlias

from tree_sitter import Node

from rebsync.reverse.syntax.cpp_words import head_of

# Readers take a few frames of Python's stack for each level; code that people write has up to 70.
DEEPEST = 150
_AROUND = 50  # levels of namespaces and classes, from which on these are what is deep
_CONTAINERS = frozenset(
    {
        *("translation_unit", "namespace_definition", "declaration_list", "class_specifier"),
        *("struct_specifier", "field_declaration_list", "linkage_specification"),
        *("function_definition", "template_declaration", "preproc_if", "preproc_ifdef"),
        *("preproc_else", "preproc_elif", "ERROR"),
    }
)
_NO_LINE_END = re.compile(rb"[^\r\n]")
_OPERATORS = b"!%&()*+,-./:<=>?[]^|~"
_ENDS = b"{};"
# What depth is told from is short: the rest of a text is left out before anything is counted.
_NO_SIGNS = bytes(set(range(256)) - set(_OPERATORS + _ENDS))
_ALIKE = bytes.maketrans(b"{[}]", b"(())")
_NO_BRACKETS = bytes(set(range(256)) - set(b"(){}[]"))
_STATEMENTS = bytes.maketrans(b"{}", b";;")
_LONG = 250  # bytes of a statement in which as many operators have room
_NO_OPERATORS = bytes(set(range(256)) - set(_OPERATORS))
_MANY = 60
_Path: TypeAlias = "tuple[Node, _Path | None, int]"


def may_be_deep(data: bytes) -> bool:
    """Whether a text needs a closer look: it nests, or has long statements or chains of `else`."""
    data = data[head_of(data) :]  # often with lines of stars, which are no operators
    if data.count(b"else") > _MANY or data.count(b"for") > _LONG or data.count(b"#") > _LONG:
        return True
    signs = data.translate(None, _NO_SIGNS)
    return _nests(signs.translate(_ALIKE, _NO_BRACKETS)) or _has_long(data, signs)


def _nests(brackets: bytes) -> bool:
    """Whether `(` nest deep, whatever of them `)` do not close."""
    left, inner = brackets, b"()"
    for levels in range(_MANY):
        shorter = left.replace(inner, b"")
        if len(shorter) == len(left):  # what is left are `)`, and `(` that nothing closes
            if levels + left.count(b"(") <= _MANY:
                return False
            break
        left = shorter
    depth = 0
    for bracket in brackets:
        if bracket == ord("("):
            depth += 1
            if depth > _MANY:
                return True
        elif depth:
            depth -= 1
    return False


def _has_long(data: bytes, signs: bytes) -> bool:
    """Whether a text has a long statement of many operators; `signs` are all that it has."""
    if max(map(len, signs.translate(_STATEMENTS).split(b";"))) <= _MANY:
        return False
    pieces = data.translate(_STATEMENTS).split(b";")
    long = (p for p in pieces if len(p) > _LONG)
    return any(len(p.translate(None, _NO_OPERATORS)) > _MANY for p in long)


def deep_parts(root: Node) -> Iterator[tuple[int, int]]:
    """The bytes of the statements and declarations that nest too deep, outer ones only."""
    end = -1
    waiting: list[_Path] = [(root, None, 0)]
    while waiting:
        path = waiting.pop()
        node, _, depth = path
        if node.start_byte < end:
            continue
        if depth > DEEPEST:
            part = _whole(path)
            end = part.end_byte
            yield part.start_byte, end
            continue
        enough = DEEPEST - depth  # a node with fewer below it cannot be too deep
        for child in reversed(node.children):
            if child.descendant_count > enough:
                waiting.append((child, path, depth + 1))


def _whole(path: _Path) -> Node:
    """The statement of a body, or the declaration, that a deep node is in."""
    nodes: list[Node] = []
    at: _Path | None = path
    while at is not None:
        nodes.append(at[0])
        at = at[1]
    nodes.reverse()
    for index, node in enumerate(nodes[:_AROUND]):
        if node.type == "compound_statement":
            return nodes[index + 1]
        if node.type not in _CONTAINERS:
            return node
    return nodes[_AROUND]


def without(data: bytes, parts: list[tuple[int, int]]) -> bytes:
    """The text with blanks for some parts that do not overlap; line ends stay."""
    pieces: list[bytes] = []
    at = 0
    for start, end in parts:
        pieces += [data[at:start], _NO_LINE_END.sub(b" ", data[start:end])]
        at = end
    return b"".join([*pieces, data[at:]])


def depth_of(node: Node) -> int:
    """How deep a call stands in its function."""
    depth, above = 0, node.parent
    while above is not None and above.type != "function_definition":
        depth, above = depth + 1, above.parent
    return depth
