"""Where generated C++ that no model describes is not as it was generated."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import zip_longest

from rebsync.reserved import MONITOR_FILES, RUNTIME_HEADERS
from rebsync.reverse.files.compiled_text import LINE_COMMENT
from rebsync.reverse.scaffold.cpp import MAIN
from rebsync.reverse.scaffold.plain_spin import Piece, with_plain_spin
from rebsync.source import Source, Span

_HEADERS = "|".join((*RUNTIME_HEADERS, *MONITOR_FILES))
HEADER = re.compile(rf"include/[^/]+/(?:{_HEADERS})\.h(?:pp)?\Z")
_STAND_IN = re.compile(r"src/\w+_stand_in\.cpp\Z")
_PROGRAM = re.compile(r"src/\w+_node\.cpp\Z")
_INCLUDE = re.compile(
    r'^[ \t]*#[ \t]*(?:include[ \t]*(?:<[^>\n]*>|("[^"\n]*"))|pragma once\b)', re.M
)
_OWN_NAME = re.compile(r'#include "(\w+)/|#ifndef (\w+)_\w+_H\b|#ifndef (\w+)__\w+_HPP_')
# The end of a literal that would take what follows it for a part of its last character.
_OPEN_ESCAPE = re.compile(r'\\(?:x[0-9a-fA-F]+|[0-7]{1,2})"\Z')
# What a rebec is made of, extraction reads.
_REBEC = re.compile(r"::\w+rebec\(node[,)]|.*(?:node\.param|readArray)\(")
# What logs texts and names of the node alone: of this nothing may fail.
_LEVEL = r"(?:DEBUG|INFO|WARN|ERROR|FATAL)(?:_ONCE)?"
_ROS1_NAME = r"ros::this_node::getName(?:space)?\(\)\.c_str\(\)"
_LOGGER = r'(?:\w+(?:->|\.)|this->)?get_logger\(\)|rclcpp::get_logger\(""\)'
_LOGS = re.compile(
    rf'(?:ROS_{_LEVEL}\(""(?P<ros1>(?:,{_ROS1_NAME})*)\)'
    rf'|RCLCPP_{_LEVEL}\((?:{_LOGGER}),""(?P<ros2>(?:,\w+(?:->|\.)get_name\(\))*)\)'
    r'|(?:std::)?printf\(""\)|std::c(?:out|err)(?:<<(?:""|std::endl))+);\Z'
)
_LITERAL = re.compile(r'"(?:\\.|[^"\\])*"')
_TOKEN = re.compile(rf'{LINE_COMMENT}|/\*.*?\*/|"(?:\\.|[^"\\])*"|\w+|\S', re.DOTALL)


def may_be_cpp_runtime(name: str) -> bool:
    """Whether a generated file may be of the run-time part, or a program."""
    return any(pattern.match(name) for pattern in (HEADER, _STAND_IN, _PROGRAM))


def first_cpp_difference(
    name: str, base: Source, source: Source, own: frozenset[str]
) -> Span | None:
    """The first place that is another, if no model describes it; `own` names the package."""
    if not HEADER.match(name) and not MAIN.search(base.text):
        return None  # a class with such a name
    cut = partial(_statements if _PROGRAM.match(name) else _tokens, own=own)
    return _first_difference(base, source, cut)


def _first_difference(
    base: Source, source: Source, cut: Callable[[Source], Iterator[Piece]]
) -> Span | None:
    """Where a text is not as another, the names of their packages apart."""
    last = len(source.text.rstrip())
    for old, new in zip_longest(cut(base), cut(source)):
        if old is None or new is None or old.text != new.text:
            return new.span if new is not None else Span(max(last - 1, 0), last)
    return None


def _tokens(source: Source, own: frozenset[str]) -> Iterator[Piece]:
    """The tokens of a text: first its own headers, in whatever order; those of libraries, none."""
    found = _OWN_NAME.search(source.text)
    every = {*own, *filter(None, found.groups() if found else ())}
    names = {form for n in every for form in (n.lower(), n.upper())}
    headers = [Piece(m[1] or "", Span(*m.span())) for m in _INCLUDE.finditer(source.text)]
    rest = _INCLUDE.sub(lambda m: " " * len(m[0]), source.text)
    tokens = [Piece(m[0], Span(*m.span())) for m in _TOKEN.finditer(rest)]
    tokens = [t for t in tokens if not t.text.startswith(("//", "/*"))]
    headers = sorted((h for h in headers if h.text), key=lambda h: h.text.rpartition("/")[2])
    for piece in (*headers, *_with_whole_literals(tokens)):
        text = piece.text
        for name in names:
            text = text.replace(name, "")
        yield Piece(text, piece.span)


def _with_whole_literals(tokens: Iterable[Piece]) -> Iterator[Piece]:
    """The tokens, with literals side by side as the one that they are to a compiler."""
    last: Piece | None = None
    for token in tokens:
        if last is not None and _continues(last.text, token.text):
            last = Piece(last.text[:-1] + token.text[1:], last.span.to(token.span))
            continue
        if last is not None:
            yield last
        last = token
    if last is not None:
        yield last


def _continues(literal: str, other: str) -> bool:
    are_both = literal[0] == '"' == other[0] and len(literal) > 1 and len(other) > 1
    return are_both and _OPEN_ESCAPE.search(literal) is None


def _statements(source: Source, own: frozenset[str]) -> Iterator[Piece]:
    """The statements of a program but for what it logs, and what it makes its rebec of."""
    yield from with_plain_spin(list(_all_statements(source, own)))


def _all_statements(source: Source, own: frozenset[str]) -> Iterator[Piece]:
    held: list[Piece] = []
    depth = 0
    for token in _tokens(source, own):
        held.append(token)
        depth += (token.text in ("(", "[")) - (token.text in (")", "]"))
        if depth == 0 and token.text in (";", "{", "}"):
            text = "".join(piece.text for piece in held)
            if not _only_logs(text) and not _REBEC.match(text):
                yield Piece(text, Span(held[0].span.start, token.span.end))
            held = []
    yield from held


def _only_logs(statement: str) -> bool:
    """Whether a statement without its layout logs, and nothing of it may fail."""
    found = _LOGS.match(_LITERAL.sub('""', statement))
    if found is None or statement.startswith("std::c"):
        return found is not None
    text = "".join(_LITERAL.findall(statement)).replace("%%", "")
    names = (found["ros1"] or found["ros2"] or "").count(",")
    return text.count("%s") == text.count("%") == names
