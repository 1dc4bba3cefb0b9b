"""Publishers that a unit keeps in maps and vectors: by keys that stand in the code."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from tree_sitter import Node

from rebsync.reverse.graph import Fact, PublisherFact
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, named, text_of

_ELEMENT = re.compile(r'(?:this->)?(\w+)\s*\[\s*("[^"]*"|\d+)\s*\]\Z')
_APPENDS = frozenset({"push_back", "emplace_back"})
FILLS = _APPENDS | {"insert", "emplace", "try_emplace", "insert_or_assign"}
LOOKS = frozenset({"size", "empty", "reserve", "at", "count", "find", "end"})
_KEYS = frozenset({"string_literal", "number_literal"})
_FLAT = frozenset({"argument_list", "call_expression", "expression_statement"})


def elements(facts: Mapping[int, PublisherFact], files: Sequence[Cpp]) -> dict[str, int]:
    """The publishers by their places, `pubs_["left"]`, by the number of their fact.

    Only of containers that nothing else is done with than to fill them once, in an order that is
    known, and to look into them.
    """
    found: dict[str, dict[str, int]] = {}
    several: set[str] = set()
    for number, fact in facts.items():
        match = _ELEMENT.match(fact.site.kept)
        name = match[1] if match is not None else fact.site.kept.removeprefix("this->")
        known = found.setdefault(name, {})
        if match is not None:
            key = f"{name}[{match[2]}]"
            several |= {name} if key in known else set()
            known[key] = number
        elif is_appended(fact):
            known[f"{name}[{len(known)}]"] = number
    return {
        key: number
        for name, keys in found.items()
        if keys and name not in several and _is_filled_once(name, keys, facts, files)
        for key, number in keys.items()
    }


def is_appended(fact: Fact) -> bool:
    """Whether what is asked for is put at the end of a vector, whenever its function runs."""
    at, appends = fact.site.call.parent, False
    while at is not None and at.type in _FLAT:
        appends = appends or _called_on(at) in _APPENDS
        at = at.parent
    body = at.parent if at is not None and at.type == "compound_statement" else None
    return appends and body is not None and body.type == "function_definition"


def _called_on(node: Node) -> str:
    function = node.child_by_field_name("function")
    field = function.child_by_field_name("field") if function is not None else None
    return text_of(field) if field is not None else ""


def _place_of(function: CppFunction | None) -> tuple[str, int] | None:
    """What tells a function from others."""
    return (function.cpp.source.path, function.node.start_byte) if function is not None else None


def _is_filled_once(
    name: str, keys: Mapping[str, int], facts: Mapping[int, PublisherFact], files: Sequence[Cpp]
) -> bool:
    functions = {_place_of(facts[n].site.function) for n in keys.values()}
    appended = [is_appended(facts[n]) for n in keys.values()]
    if any(appended) and (not all(appended) or len(functions) != 1):
        return False
    written = 0
    for node in places(name, files):
        use = _use(node)
        if use is None:
            return False
        written += use
    return written == len(keys)


def places(name: str, files: Sequence[Cpp]) -> Iterator[Node]:
    """Where a name stands in some files; in a macro, that."""
    pattern = re.compile(rb"\b" + re.escape(name.encode()) + rb"\b")
    for cpp in files:
        data, first = cpp.root.text or b"", cpp.root.start_byte
        for match in pattern.finditer(data):
            start = match.start() + first
            node = cpp.root.descendant_for_byte_range(start, start + len(match[0]))
            if node is not None and node.type in ("identifier", "field_identifier", "preproc_arg"):
                yield node


def _use(node: Node) -> int | None:
    """How many publishers a place in the code puts into a container; None for another use."""
    above = node.parent
    if above is not None and text_of(above) == f"this->{text_of(node)}":
        above = above.parent
    if above is None:
        return None
    match above.type:
        case "field_declaration" | "declaration" | "array_declarator":
            return 0
        case "field_expression":
            field = above.child_by_field_name("field")
            name = text_of(field) if field is not None else ""
            return 1 if name in _APPENDS else (0 if name in LOOKS else None)
        case "subscript_expression":
            return _element(above)
        case _:
            return None


def _element(place: Node) -> int | None:
    indices = place.child_by_field_name("indices")
    keys = named(indices) if indices is not None else []
    above = place.parent
    literal = len(keys) == 1 and keys[0].type in _KEYS
    if above is not None and above.type == "field_expression":
        field = above.child_by_field_name("field")
        return 0 if field is not None and text_of(field) in libraries.named(Kind.PUBLISH) else None
    if above is not None and above.type == "assignment_expression" and literal:
        left = above.child_by_field_name("left")
        flat = above.parent is not None and above.parent.type == "expression_statement"
        return 1 if left is not None and left.id == place.id and flat else None
    return None
