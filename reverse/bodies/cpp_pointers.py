"""Members that point to a message or to none, and constants of the type of a message."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.scope import Record, Scope
from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.source import Span

_GIVEN = re.compile(r"(?:std::move|(?:(?:std|boost)::)?make_(?:shared|unique)\b)")
_NULL = ("nullptr", "NULL", "std::nullopt", "nullopt")
# Where it counts whether a pointer points to something.
_TESTS = (
    r"!\s*(?:this->)?{name}\b(?!\s*(?:->|\.))",
    r"\b{name}\s*[=!]=\s*(?:nullptr|NULL)\b",
    r"\b(?:nullptr|NULL)\s*[=!]=\s*(?:this->)?{name}\b",
    r"(?:\(|&&|\|\|)\s*(?:this->)?{name}\s*(?:\)|&&|\|\||\?)",
    r"\b{name}\.reset\(\s*\)",
)


@lru_cache(maxsize=512)
def _test_of(name: str) -> re.Pattern[str]:
    return re.compile("|".join(_TESTS).replace("{name}", re.escape(name)))


def is_tested(name: str, text: str) -> bool:
    """Whether code looks at whether a pointer points to something, or lets it point to nothing."""
    return name in text and _test_of(name).search(text) is not None


def check_shared(cpp: Cpp, record: Record, target: Node, value: Node) -> None:
    """Raises `Unread` where a pointer gets to a message that may be changed by another one."""
    if not record.shared or "pointer_expression" in (target.type, value.type):
        return
    if value.type == "call_expression" and _GIVEN.match(text_of(value)):
        return
    raise Unread(cpp.span(value), "a message is changed by a pointer, and has several")


def is_null(node: Node) -> bool:
    """Whether it points to nothing."""
    return text_of(node) in _NULL


def pointed(scope: Scope, node: Node) -> Record | None:
    """The message of a member that may point to none, by the name of the pointer; else None."""
    if node.type not in ("identifier", "field_expression"):
        return None
    meaning = resolve(scope, node)
    return meaning if isinstance(meaning, Record) and meaning.there else None


def points(record: Record, is_there: m.Expression, span: Span) -> m.Statement:
    """A pointer gets to a message, or to none."""
    return m.ExpressionStatement(m.Assign("=", m.Name(record.there), is_there, span), (), span)


def ended(cpp: Cpp, scope: Scope, node: Node, function: Node) -> Iterator[m.Statement] | None:
    """`pointer.reset()`; None for a call of something else."""
    record = pointed(scope, part(function, "argument"))
    is_of_message = any(c.type == "->" for c in function.children)
    if record is None or text_of(part(function, "field")) != "reset" or is_of_message:
        return None
    if named(part(node, "arguments")):
        return None
    return iter((points(record, m.BoolLiteral(False), cpp.span(node)),))


def is_there(reader: CppExpressionReader, node: Node) -> m.Expression | None:
    """Whether a member points to a message: `last_`, `last_ != nullptr`; None for all else."""
    there, at = True, node
    if node.type == "binary_expression" and text_of(part(node, "operator")) in ("==", "!="):
        operands = [n for n in named(node) if not is_null(n)]
        if len(operands) != 1:
            return None
        there, (at,) = text_of(part(node, "operator")) == "!=", operands
    record = pointed(reader.scope, at)
    if record is None:
        return None
    found = m.Name(record.there, reader.cpp.span(at))
    return found if there else m.Unary("!", found, reader.cpp.span(node))


def constant_of_message(scope: Scope, node: Node) -> int | str | None:
    """`msg->RUN`: a constant of the type of a message."""
    holder, name = node.child_by_field_name("argument"), node.child_by_field_name("field")
    record = resolve(scope, holder) if holder is not None else None
    if not isinstance(record, Record) or not record.type or name is None:
        return None
    return scope.enumerators.get(f"{record.type.replace('/', '::')}::{text_of(name)}")
