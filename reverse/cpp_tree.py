"""C++ text to a syntax tree, with places in the text as the rest of rebsync counts them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import field
from functools import cache

import tree_sitter_cpp
from tree_sitter import Language, Node, Parser

from rebsync.records import dataclass
from rebsync.reverse.cpp_text import readable
from rebsync.source import Source, SourceSpan, Span

_COMMENT = re.compile(r"^\s*//[/!]?|^\s*/\*+|\*+/\s*\Z")


@dataclass(frozen=True)
class Cpp:
    """One file of C++ and its tree; `offsets` is None where bytes and characters are the same."""

    source: Source
    root: Node = field(repr=False)
    offsets: tuple[int, ...] | None = field(repr=False)

    def span(self, node: Node) -> Span:
        """The characters that a node covers."""
        start, end = node.start_byte, node.end_byte
        if self.offsets is not None:
            start, end = self.offsets[start], self.offsets[end]
        return SourceSpan(start, end, self.source)


@cache
def _parser() -> Parser:
    return Parser(Language(tree_sitter_cpp.language()))


def parse(source: Source) -> Cpp:
    """The tree of a file; where the text is no C++ it has error nodes."""
    text = readable(source.text)
    data = text.encode("utf-8", "surrogatepass")
    offsets = None if len(data) == len(text) else tuple(_characters(text))
    return Cpp(source, _parser().parse(data).root_node, offsets)


def _characters(text: str) -> Iterator[int]:
    """For each byte the character it belongs to, then the length of the text."""
    for index, character in enumerate(text):
        for _ in character.encode("utf-8", "surrogatepass"):
            yield index
    yield len(text)


def text_of(node: Node) -> str:
    """The text of a node."""
    return (node.text or b"").decode("utf-8", "replace")


def named(node: Node) -> list[Node]:
    """The named children of a node but for comments."""
    return [c for c in node.named_children if c.type != "comment"]


def part(node: Node, name: str) -> Node:
    """The child in a field that the grammar promises; ValueError where a broken text lacks it."""
    child = node.child_by_field_name(name)
    if child is None:
        raise ValueError(f"{node.type} without {name}")
    return child


def markers_above(node: Node) -> tuple[str, ...]:
    """The markers in the comments directly before a node."""
    found: list[str] = []
    before = node.prev_sibling
    while before is not None and before.type == "comment" and not _trails(before):
        found.append(text_of(before))
        before = before.prev_sibling
    return markers_in(reversed(found))


def markers_beside(node: Node) -> tuple[str, ...]:
    """The markers in the comments that follow a node on its last line, and go on below."""
    found: list[str] = []
    after = node.next_sibling
    row = node.end_point[0]
    while (
        after is not None and after.type == "comment" and after.start_point[0] <= row + len(found)
    ):
        found.append(text_of(after))
        after = after.next_sibling
    return markers_in(found)


def markers_in(comments: Iterable[str]) -> tuple[str, ...]:
    """`kind path` of the markers in comments that follow each other.

    A formatter may have split a marker over lines, or joined two.
    """
    text = " ".join(_COMMENT.sub(" ", comment) for comment in comments)
    return tuple(" ".join(piece.split()) for piece in text.split("rebsync:")[1:])


def _trails(comment: Node) -> bool:
    """Whether a comment stands behind something on its line."""
    before = comment.prev_sibling
    return before is not None and before.end_point[0] == comment.start_point[0]
