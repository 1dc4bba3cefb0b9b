"""Statements that a model has, which may throw for what it says nothing of.

In a model times are whole numbers, which have no range and no clock, parameters have the types that
they are asked for, and pointers lead to something. An index of an array of the model is said there.
"""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.analysis.problems import NOTHING_THERE
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.syntax.cpp_tree import inside, part
from rebsync.source import Span

_STATEMENTS = (
    *("expression_statement", "declaration", "return_statement", "if_statement", "for_statement"),
    *("while_statement", "do_statement", "switch_statement", "for_range_loop", "try_statement"),
)


def check(reader: CppStatementReader, node: Node) -> None:
    """Raises `Unread` where a statement, but for those in it, may throw so."""
    form, cpp = reader.scope.form, reader.cpp
    if form is None or not reader.scope.open:
        return
    found = form.unsaid(cpp, node)
    nested = [inner for inner in inside(node, *_STATEMENTS) if inner != node] if found else []
    spans = [cpp.span(inner) for inner in nested]
    for problem in found:
        start, end = problem.place.start, problem.place.end
        if any(s.start <= start and end <= s.end for s in spans):
            continue
        if problem.why != NOTHING_THERE or not _indexes_model(reader, node, problem.place):
            raise reader.unread(node, problem.why, "catch what it throws, or look before")


def _indexes_model(reader: CppStatementReader, node: Node, place: Span) -> bool:
    """Whether an element that a statement names is one that the model has, or of its arrays.

    Locals that nothing needs are not in a model, nor is what they are computed of.
    """
    if node.type == "declaration":
        return False
    indexed = [n for n in inside(node, "subscript_expression") if reader.cpp.span(n) == place]
    arrays = (resolve(reader.scope, part(n, "argument")) for n in indexed)
    is_known = any(resolve(reader.scope, n) is not None for n in indexed)
    return is_known or any(isinstance(array, Variable) for array in arrays)
