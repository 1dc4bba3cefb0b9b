"""Members that point to a message or to none, and constants of the type of a message."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.scope import Record, Scope
from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.source import Span

if TYPE_CHECKING:
    from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader

_CHANGE = re.compile(
    r"\b(\w+)\s*->\s*(\w+)[\w.\s]*(?:[-+*/|&^%]?=(?!=)|\+\+|--)"
    r"|(?:\+\+|--)\s*(\w+)\s*->\s*(\w+)"
)
# A part of a message that something refers to, or that a function gets.
_PART = re.compile(r"->\s*(\w+)(?:\s*\.\s*\w+)*\s*[,;)]")
_WHOLE = re.compile(r"(?<=[(=,&|!{;}?:])\s*\*\s*(?:this->)?(\w+)\b|\breturn\s*\*\s*(\w+)\b")
_FIELD = re.compile(r"\s*\)\s*\.\s*\w+(?:\s*\.\s*\w+)*\s*(?![\w.\s]|[-+*/|&^%]?=(?!=)|\+\+|--|\()")
_REFERS = re.compile(r"([^;{}]*)&\s*\w+\s*=\s*\(?\*?(?:this->)?\w+\)?\s*(?:->|\.)")
_COPIES = re.compile(r"(?:^|\s)(?:const\s+)?[\w:]+(?:\s+\w+)?\s*=\s*$")
_NEW = r"\b{name}\s*(?:=\s*)?[({{]?\s*(?:(?:std|boost)::make_(?:shared|unique)|new)\b"
_GIVEN = re.compile(r"(?:std::move|(?:(?:std|boost)::)?make_(?:shared|unique)\b)")
_NULL = ("nullptr", "NULL")
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


def is_changed(fields: Iterable[str], text: str) -> bool:
    """Whether code may set fields of a message by a pointer, other than a new message's own.

    By the arrow, or by what refers to the message or a part of it.
    """
    paths = list(fields)
    names = {path.partition(".")[0] for path in paths}
    parts = {path.partition(".")[0] for path in paths if "." in path}
    for found in _CHANGE.finditer(text):
        name, field = found[1] or found[3], found[2] or found[4]
        is_new = re.search(_NEW.format(name=name), text) is not None
        if field in names and not is_new:
            return True
    if any(found[1] in parts for found in _PART.finditer(text)):
        return True
    if any("const" not in found[1] for found in _REFERS.finditer(text)):
        return True
    return any(not _is_read(text, found) for found in _WHOLE.finditer(text))


def _is_read(text: str, found: re.Match[str]) -> bool:
    """Whether what a pointer points to is only read: published, copied, or a field of it."""
    before = re.split(r"[;{}]", text[: found.start()])[-1]
    after = text[found.end() :]
    if _FIELD.match(after):
        return True
    if "&" in before and "const" not in before:
        return False
    is_copied = re.match(r"\s*;", after) is not None and _COPIES.search(before) is not None
    return is_copied or re.search(r"publish\(\s*$", before) is not None


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


def constant_of_message(scope: Scope, node: Node) -> int | None:
    """`msg->RUN`: a constant of the type of a message."""
    holder, name = node.child_by_field_name("argument"), node.child_by_field_name("field")
    record = resolve(scope, holder) if holder is not None else None
    if not isinstance(record, Record) or not record.type or name is None:
        return None
    return scope.enumerators.get(f"{record.type.replace('/', '::')}::{text_of(name)}")
