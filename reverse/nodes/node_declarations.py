"""What stands in the bodies of functions, and of which parts a variable is made."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import named, part, text_of


def pair_of(type_: Node) -> tuple[Node, Node] | None:
    """The two types of a `std::pair`; None for other types."""
    if type_.type == "qualified_identifier" and text_of(part(type_, "scope")) == "std":
        type_ = part(type_, "name")
        if type_.type == "template_type" and text_of(part(type_, "name")) == "pair":
            first, second = named(part(type_, "arguments"))
            return first, second
    return None


def stands_in(function: CppFunction, word: str) -> bool:
    """Whether a word is in the body of a function at all."""
    if function.body is None or word.encode() not in function.cpp.words:
        return False
    at, end = function.body.start_byte, function.body.end_byte
    return function.cpp.original.find(word.encode(), at, end) >= 0


def declarations(code: Code, function: CppFunction) -> Iterator[Node]:
    """Those of a body itself, not of lambdas in it."""
    end = -1
    for node in code.inside(function.cpp, function.body, "declaration", "lambda_expression"):
        if node.start_byte >= end:
            if node.type == "declaration":
                yield node
            else:
                end = node.end_byte
