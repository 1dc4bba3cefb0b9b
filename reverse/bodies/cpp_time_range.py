"""Statements that compute times which may be beyond their range, of which a model says nothing.

In a model times are whole numbers, which have no range and no clock.
"""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.analysis.problems import BEYOND_TIMES
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.syntax.cpp_tree import inside

_TIMES = re.compile(rb"\b(?:Time|Duration|Rate|WallTime|WallDuration|WallRate)\b")
_STATEMENTS = (
    *("expression_statement", "declaration", "return_statement", "if_statement", "for_statement"),
    *("while_statement", "do_statement", "switch_statement", "for_range_loop", "try_statement"),
)


def check(reader: CppStatementReader, node: Node) -> None:
    """Raises `Unread` where a statement, but for those in it, may throw for a time."""
    form, cpp = reader.scope.form, reader.cpp
    if form is None or not reader.scope.open or not _TIMES.search(cpp.data):
        return
    found = form.beyond_times(cpp, node)
    nested = inside(node, *_STATEMENTS) if found else ()
    spans = [cpp.span(inner) for inner in nested if inner != node]
    if any(not any(s.start <= p.start and p.end <= s.end for s in spans) for p in found):
        raise reader.unread(node, BEYOND_TIMES, "catch what it throws, or look before")
