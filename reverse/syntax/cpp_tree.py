"""C++ text to a syntax tree, with places in the text as the rest of rebsync counts them."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import field
from functools import cache, cached_property

import tree_sitter_cpp
from tree_sitter import Language, Node, Parser, Query, QueryCursor

from rebsync.records import dataclass
from rebsync.reverse.syntax.cpp_depth import deep_parts, may_be_deep, without
from rebsync.reverse.syntax.cpp_text import readable
from rebsync.reverse.syntax.cpp_words import Plain
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.source import Source, SourceSpan, Span

_MOST_COMMENTS = 60  # each is looked for from the start of what is around it
_NEAR = 200  # bytes that are looked at before a brace
_NOT_ASCII = re.compile(r"[^\x00-\x7f]")
_INVERTED = re.compile(rb"[\s(]*~")
_DOUBLE_BRACES = re.compile(rb"\{(?=(\s)\s*\{)")
_ELEMENTS = frozenset({"initializer_list", "parenthesized_expression"})
_COMMENT = re.compile(r"^\s*//[/!]?|^\s*/\*+|\*+/\s*\Z")


@dataclass(frozen=True)
class Cpp:
    """One file of C++ and its tree, whose places are bytes.

    `plain` is the text as it was read. `wide` are the bytes behind each character that takes more
    than one, and by how many bytes more than characters the text up to there has. `deep` are the
    bytes of places that nest deeper than is read: they are not in the tree. `inverted` are the
    bytes of each `~` that is `!` in the tree, `filled` those of each `;` that is only in the tree.
    `is_beside`: the file is of another package, which is read for what this one takes of it.
    """

    source: Source
    root: Node = field(repr=False)
    plain: Plain = field(repr=False, compare=False)
    wide: tuple[list[int], list[int]] | None = field(repr=False)
    deep: tuple[tuple[int, int], ...] = ()
    inverted: frozenset[int] = frozenset()
    filled: frozenset[int] = frozenset()
    is_beside: bool = False

    @cached_property
    def data(self) -> bytes:
        """The text as it was parsed; the root begins behind the first white space."""
        return b" " * self.root.start_byte + (self.root.text or b"")

    @cached_property
    def original(self) -> bytes:
        """The text as it was read; places are the same."""
        return self.plain.data

    @cached_property
    def words(self) -> frozenset[bytes]:
        """All words of the text: what is not among them stands nowhere in it."""
        return self.plain.words

    @property
    def has_markers(self) -> bool:
        """Whether there may be markers in its comments."""
        return b"rebsync" in self.words

    def text(self, node: Node) -> str:
        """The text of one of its nodes: in a third of the time that `text_of` takes."""
        piece = self.data[node.start_byte : node.end_byte]
        try:
            return piece.decode()
        except UnicodeDecodeError:
            return piece.decode("utf-8", "replace")

    def operator(self, node: Node) -> str:
        """The operator of an operation."""
        operator = part(node, "operator")
        return "~" if operator.start_byte in self.inverted else text_of(operator)

    def span(self, node: Node) -> Span:
        """The characters that a node covers."""
        if self.wide is None:
            return SourceSpan(node.start_byte, node.end_byte, self.source)
        return self.source.within(self.characters(node.start_byte, node.end_byte))

    def characters(self, start: int, end: int) -> Span:
        """The characters that some bytes are."""
        if self.wide is None:
            return Span(start, end)
        return Span(self._character(start), self._character(end))

    def _character(self, byte: int) -> int:
        ends, surplus = self.wide or ([], [])
        before = bisect_right(ends, byte)
        return byte - (surplus[before - 1] if before else 0)


_LANGUAGE = Language(tree_sitter_cpp.language())
# The numbers of fields: a child is found by them in half the time that it takes by their names.
FIELDS = {str(_LANGUAGE.field_name_for_id(n)): n for n in range(1, _LANGUAGE.field_count + 1)}
_COMMENT_KIND = _LANGUAGE.id_for_node_kind("comment", True)


@cache
def _parser() -> Parser:
    return Parser(_LANGUAGE)


def parse(source: Source, is_beside: bool = False) -> Cpp:
    """The tree of a file; where the text is no C++ it has error nodes.

    `is_beside`: the file is of another package than what is read.
    """
    plain = Plain(source.text.encode("utf-8", "surrogatepass"))
    text = readable(source.text, plain)
    data = plain.data if text == source.text else text.encode("utf-8", "surrogatepass")
    wide = byte_places(text, data)
    root = _parser().parse(data).root_node
    deep: list[tuple[int, int]] = []
    while may_be_deep(data) and (parts := list(deep_parts(root))):
        deep += parts
        data = without(data, parts)
        root = _parser().parse(data).root_node
    filled: frozenset[int] = frozenset()
    doubled = frozenset(_double_braces(data)) if root.has_error else filled
    if not all(_is_block(root, place) for place in doubled):
        data, root, filled = _told_from_lists(data, root, doubled)
    inverted: set[int] = set()
    while root.has_error and (found := list(_taken_for_destructors(root, data))):
        inverted.update(found)
        data = _with_negations(data, found)
        root = _parser().parse(data).root_node
    return Cpp(source, root, plain, wide, tuple(deep), frozenset(inverted), filled, is_beside)


def parse_as_it_is(source: Source) -> Cpp:
    """The tree of a file, in which nothing is mended or left out."""
    data = source.text.encode("utf-8", "surrogatepass")
    root = _parser().parse(data).root_node
    return Cpp(source, root, Plain(data), byte_places(source.text, data))


def _double_braces(data: bytes) -> Iterator[int]:
    """The space between `{ {` where this is no list of values behind a sign."""
    for found in _DOUBLE_BRACES.finditer(data):
        if data[max(0, found.start() - _NEAR) : found.start()].rstrip()[-1:] not in b"=,(":
            yield found.start(1)


def _is_block(root: Node, place: int) -> bool:
    """Whether what is around the space between `{ {` was read as a block, and all of it."""
    node = root.descendant_for_byte_range(place - 1, place + 1)
    return node is not None and node.type == "compound_statement" and not node.has_error


def _told_from_lists(
    data: bytes, root: Node, places: frozenset[int]
) -> tuple[bytes, Node, frozenset[int]]:
    """Blocks that begin with blocks, `{ { } }`, which the grammar may take for lists of values.

    A `;` between the braces tells them apart.
    """
    changed = bytearray(data)
    for place in places:
        changed[place] = ord(";")
    better = _parser().parse(bytes(changed)).root_node
    if sum(1 for _ in _errors(better)) < sum(1 for _ in _errors(root)):
        return bytes(changed), better, places
    return data, root, frozenset()


def _taken_for_destructors(root: Node, data: bytes) -> Iterator[int]:
    """The bytes of `~` with which elements in braces begin, `{~x[0], 1}`.

    There the grammar looks for the name of a destructor, and finds an error; with `!` it does not.
    """
    for node in _errors(root):
        sign = _INVERTED.match(data, node.start_byte) if node.is_error else None
        if sign is not None and node.parent is not None and node.parent.type in _ELEMENTS:
            yield sign.end() - 1


def _errors(root: Node) -> Iterator[Node]:
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if node.is_error or node.is_missing:
            yield node
        if node.has_error:
            waiting += reversed(node.children)


def _with_negations(data: bytes, places: Iterable[int]) -> bytes:
    changed = bytearray(data)
    for place in places:
        changed[place] = ord("!")
    return bytes(changed)


def byte_places(text: str, data: bytes) -> tuple[list[int], list[int]] | None:
    """The byte behind each character that is not ASCII, and how many bytes too many come before.

    None where each character is one byte.
    """
    if len(data) == len(text):
        return None
    ends: list[int] = []
    surplus: list[int] = []
    more = 0
    for match in _NOT_ASCII.finditer(text):
        more += len(match[0].encode("utf-8", "surrogatepass")) - 1
        ends.append(match.end() + more)
        surplus.append(more)
    return ends, surplus


def text_of(node: Node) -> str:
    """The text of a node."""
    text = node.text or b""
    try:
        return text.decode()  # without a way to treat errors much quicker
    except UnicodeDecodeError:
        return text.decode("utf-8", "replace")


def squeezed(node: Node) -> str:
    """The text of a node without its layout."""
    return "".join(text_of(node).split())


def last_name(node: Node) -> str:
    """The last part of a qualified name, however it is laid out."""
    return text_of(node).rpartition("::")[2].strip()


def named(node: Node) -> list[Node]:
    """The named children of a node but for comments."""
    return [c for c in node.named_children if c.kind_id != _COMMENT_KIND]


def inside(node: Node | None, *types: str) -> list[Node]:
    """The nodes of some types in a node, itself included, outer ones first, in the text's order.

    Many nodes are better searched once for all types that are ever asked for: see `by_types`.
    """
    found: list[Node] = []
    waiting = [node] if node is not None else []
    while waiting:
        current = waiting.pop()
        if current.type in types:
            found.append(current)
        if current.named_child_count:
            waiting += reversed(current.named_children)
    return found


def returns_in(body: Node | None) -> Iterator[Node]:
    """The `return` statements of a body, not those of lambdas in it."""
    inner = nodes_in(body, "lambda_expression") if body is not None else ()
    return (n for n in inner if n.type == "return_statement")


def by_types(node: Node, types: tuple[str, ...]) -> dict[str, list[Node]]:
    """The nodes of each of some types in a node, in no order: one search finds them all.

    The parser's library looks for them, which is much quicker than going through a tree; but to
    make it ready for other types takes as long as to parse 50 kB.
    """
    return QueryCursor(_query(types)).captures(node)


def in_text_order(nodes: Iterable[Node]) -> list[Node]:
    """Nodes of a tree as they begin in the text, outer ones first."""
    return sorted(nodes, key=_in_text)


@cache
def _query(types: tuple[str, ...]) -> Query:
    return Query(_LANGUAGE, " ".join(f"({type_}) @{type_}" for type_ in types))


def _in_text(node: Node) -> tuple[int, int]:
    return node.start_byte, -node.end_byte


def part(node: Node, name: str) -> Node:
    """The child in a field that the grammar promises; ValueError where a broken text lacks it."""
    child = node.child_by_field_id(FIELDS[name])
    if child is None:
        raise ValueError(f"{node.type} without {name}")
    return child


def default_of(parameter: Node) -> Node | None:
    """What a parameter is by default; braces alone the grammar takes for an object without type."""
    value = parameter.child_by_field_name("default_value")
    type_ = value.child_by_field_name("type") if value is not None else None
    return part(type_.parent, "value") if type_ and type_.is_missing and type_.parent else value


def operator_of(node: Node) -> str:
    """The operator of an expression; empty where it has none."""
    operator = node.child_by_field_name("operator")
    return text_of(operator) if operator is not None else ""


def markers_above(node: Node) -> tuple[str, ...]:
    """The markers in the comments directly before a node."""
    found: list[str] = []
    before = node.prev_sibling
    while before is not None and before.type == "comment" and not _trails(before):
        found.append(text_of(before))
        if len(found) > _MOST_COMMENTS:
            break
        before = before.prev_sibling
    return markers_in(reversed(found))


def markers_beside(node: Node) -> tuple[str, ...]:
    """The markers in the comments that follow a node on its last line, and go on below.

    A marker that begins below is that of what follows.
    """
    found: list[str] = []
    after = node.next_sibling
    row = node.end_point[0]
    while (
        after is not None and after.type == "comment" and after.start_point[0] <= row + len(found)
    ):
        text = text_of(after)
        if after.start_point[0] > row and "rebsync:" in text:
            break
        found.append(text)
        after = after.next_sibling
    return markers_in(found)


def markers_in(comments: Iterable[str]) -> tuple[str, ...]:
    """`kind path` of the markers in comments that follow each other.

    A formatter may have split a marker over lines, or joined two.
    """
    marked = list(comments)
    if not any("rebsync:" in comment for comment in marked):
        return ()
    text = " ".join(_COMMENT.sub(" ", comment) for comment in marked)
    return tuple(" ".join(piece.split()) for piece in text.split("rebsync:")[1:])


def _trails(comment: Node) -> bool:
    """Whether a comment stands behind something on its line."""
    before = comment.prev_sibling
    return before is not None and before.end_point[0] == comment.start_point[0]


def unqualified(name: Node) -> Node:
    """A name, or the template that it is of, without the scopes before it."""
    while name.type == "qualified_identifier":
        name = part(name, "name")
    return name
