"""What declarations of variables, and bodies of functions, say by how they are written."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_pointers import is_null, is_tested
from rebsync.reverse.bodies.scope import Stores
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_numerals import whole_number
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of


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


def number_of(code: Code, cpp: Cpp, node: Node) -> int | None:
    """A whole number, or that of a constant."""
    found = code.constants_for(cpp).get(text_of(node))
    return whole_number(text_of(found[1] if found is not None else node))


def stored_in_optional(there: m.Name, held: m.Name, value: Node) -> tuple[Stores, ...]:
    """What an optional holds from the start: of other values than literals it is not read."""
    if is_null(value):
        return (Stores(there, m.BoolLiteral(False)),)
    if value.type in ("number_literal", "unary_expression", "true", "false"):
        return (Stores(held, value), Stores(there, m.BoolLiteral(True)))
    around = value.parent or value
    return (Stores(held, around), Stores(there, around))


def is_static(node: Node) -> bool:
    """Whether there is one of a variable for all objects."""
    return any(text_of(c) == "static" for c in node.named_children)


def is_asked(name: str, functions: Sequence[CppFunction]) -> bool:
    """Whether some function asks whether an optional is there, or does not care."""
    asks = re.compile(rf"\b{re.escape(name)}\s*(?:\.\s*(?:has_value|value|value_or)\b|[=!]=)")
    texts = [text_of(function.node) for function in functions]
    return any(is_tested(name, text) or asks.search(text) is not None for text in texts)
