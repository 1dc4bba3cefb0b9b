"""What is looked for in the trees of files: each file is searched once for all that is asked."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Collection
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, name_called
from rebsync.reverse.syntax.cpp_tree import Cpp, by_types, in_text_order, inside
from rebsync.reverse.syntax.cpp_words import places_of

# The types of nodes that are looked for.
SOUGHT = (
    *("call_expression", "declaration", "for_range_loop", "init_declarator"),
    *("lambda_expression", "parameter_declaration"),
)
# The first character is one of three: so most of a text is passed over quickly.
_HANDED = re.compile(r"[.>&](?:(?:(?<=\.)|(?<=->))\s*(\w+)\s*\(|(?<=&)\s*(?:\w+::)*(\w+))")
_NAMES = frozenset({"identifier", "type_identifier", "field_identifier"})
# Nodes of a body, from which on a search of its file for good is quicker than looking through it.
_MANY = 3000


@dataclass(slots=True)
class Searches:
    """Finds nodes, calls and names in files, and remembers them; nodes stand for their bodies."""

    _calls: dict[int, tuple[CppCall, ...]] = field(default_factory=dict)
    _names: dict[int, frozenset[str]] = field(default_factory=dict)
    _handed: dict[int, frozenset[str]] = field(default_factory=dict)
    _nodes: dict[int, dict[str, list[Node]]] = field(default_factory=dict)
    _words: dict[tuple[int, str], tuple[list[int], list[Node]]] = field(default_factory=dict)
    _sorted: dict[tuple[int, tuple[str, ...]], tuple[list[int], list[Node]]] = field(
        default_factory=dict
    )

    def inside(self, cpp: Cpp, node: Node | None, *types: str) -> list[Node]:
        """The nodes of some types in a node of a file, outer ones first, in the text's order.

        A file is searched once for them all, unless it is little that is asked for. The types are
        some of `SOUGHT`.
        """
        if node is None:
            return []
        if id(cpp) not in self._nodes and node.descendant_count <= _MANY:
            return inside(node, *types)
        key = id(cpp), types
        if key not in self._sorted:
            if id(cpp) not in self._nodes:
                self._nodes[id(cpp)] = by_types(cpp.root, SOUGHT)
            found = self._nodes[id(cpp)]
            nodes = in_text_order(n for type_ in types for n in found.get(type_, ()))
            self._sorted[key] = [n.start_byte for n in nodes], nodes
        starts, nodes = self._sorted[key]
        end = node.end_byte
        first, behind = bisect_left(starts, node.start_byte), bisect_left(starts, end)
        return [n for n in nodes[first:behind] if n.end_byte <= end]

    def named(self, cpp: Cpp, node: Node, names: Collection[str]) -> list[Node]:
        """The nodes in a node of a file that are some words, in the order of the text."""
        found: list[Node] = []
        start, end = node.start_byte, node.end_byte
        for name in names:
            word = name.encode()
            if word not in cpp.words:
                continue
            # Most names of a file are not in one body, and then not asked for in others either.
            if (id(cpp), name) in self._words or cpp.original.find(word, start, end) >= 0:
                starts, nodes = self._named(cpp, name)
                found += nodes[bisect_left(starts, start) : bisect_left(starts, end)]
        return in_text_order(found) if len(names) > 1 else found

    def _named(self, cpp: Cpp, name: str) -> tuple[list[int], list[Node]]:
        """All places of a file where a name stands in the code: bytes, and nodes."""
        key = id(cpp), name
        if key not in self._words:
            word = name.encode()
            nodes = []
            for at in places_of(cpp.original, word):
                node = cpp.root.descendant_for_byte_range(at, at + len(word))
                if node is not None and node.type in _NAMES and node.start_byte == at:
                    nodes.append(node)
            self._words[key] = [n.start_byte for n in nodes], nodes
        return self._words[key]

    def calls_in(self, cpp: Cpp, body: Node) -> tuple[CppCall, ...]:
        """The calls in a body, outer ones first, in the order of the text."""
        if body.id not in self._calls:
            found = map(call_of, self._called_in(cpp, body))
            self._calls[body.id] = tuple(c for c in found if c is not None)
        return self._calls[body.id]

    def _called_in(self, cpp: Cpp, body: Node) -> list[Node]:
        """The nodes of the calls in a body, outer ones first, in the order of the text.

        A call is the smallest node that has the parenthesis of its arguments and what comes before
        it. In a broken text there may be calls without one.
        """
        if body.has_error or body.descendant_count > _MANY:
            return self.inside(cpp, body, "call_expression")
        found: dict[int, Node] = {}
        at = cpp.data.find(b"(", body.start_byte, body.end_byte)
        while at >= 0:
            node = body.named_descendant_for_byte_range(at - 1, at + 1)
            if node is not None and node.type == "call_expression":
                found[node.id] = node
            at = cpp.data.find(b"(", at + 1, body.end_byte)
        return in_text_order(found.values())

    def names_called(self, cpp: Cpp, body: Node) -> frozenset[str]:
        """The last names of what a body calls."""
        if body.id not in self._names:
            calls = self._called_in(cpp, body)
            self._names[body.id] = frozenset(name_called(cpp, call) for call in calls)
        return self._names[body.id]

    def handed_on(self, cpp: Cpp, wanted: Collection[str]) -> frozenset[str]:
        """The names of functions that a file calls on an object, or hands on.

        Empty where none of those that are wanted is among its words.
        """
        if cpp.words.isdisjoint(name.encode() for name in wanted):
            return frozenset()
        if id(cpp) not in self._handed:
            found = _HANDED.findall(cpp.source.text)
            self._handed[id(cpp)] = frozenset(one or other for one, other in found)
        return self._handed[id(cpp)]
