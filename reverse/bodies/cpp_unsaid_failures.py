"""Statements that a model has, which may throw for what it says nothing of.

In a model times are whole numbers, which have no range and no clock, and parameters have the types
that they are asked for.
"""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.syntax.cpp_tree import inside

_CAUSES = re.compile(rb"\b(?:(?:Wall)?(?:Time|Duration|Rate)|declare_parameter|as_\w+)\b")
_STATEMENTS = (
    *("expression_statement", "declaration", "return_statement", "if_statement", "for_statement"),
    *("while_statement", "do_statement", "switch_statement", "for_range_loop", "try_statement"),
)


def check(reader: CppStatementReader, node: Node) -> None:
    """Raises `Unread` where a statement, but for those in it, may throw so."""
    form, cpp = reader.scope.form, reader.cpp
    if form is None or not reader.scope.open or not _CAUSES.search(cpp.data):
        return
    found = form.unsaid(cpp, node)
    nested = [inner for inner in inside(node, *_STATEMENTS) if inner != node] if found else []
    spans = [cpp.span(inner) for inner in nested]
    for problem in found:
        start, end = problem.place.start, problem.place.end
        if not any(s.start <= start and end <= s.end for s in spans):
            raise reader.unread(node, problem.why, "catch what it throws, or look before")
