"""What exceptions may leave statements of people's Python: the callback ends there, or the node.

The model has no exceptions. What it has of a statement raises none; neither does what a function
raises that stands in the place of its call, where that is listed.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync.reverse.python.py_tree import named, nodes_in
from rebsync.source import Span

if TYPE_CHECKING:
    from rebsync.reverse.python.body_statement_reader import BodyStatementReader

_ASSERTION = "builtins.AssertionError"  # the model has assertions
_CLAUSES = frozenset({"elif_clause", "case_clause"})
_BLOCKS = frozenset({"block", "else_clause", "finally_clause", "except_clause"})


def raised(reader: BodyStatementReader, node: Node) -> str | None:
    """What a statement that was read may raise beside those in it; None if that is nothing."""
    if reader.reading.form is None:
        return None
    for part in _own(reader, node):
        why = next(_raised(reader, reader.frame.span(part)), None)
        if why is not None:
            return why
    return None


def _raised(reader: BodyStatementReader, place: Span) -> Iterator[str]:
    reading, form = reader.reading, reader.reading.form
    assert form is not None
    here = reader.frame.scope
    for problem, scope in form.raised(reader.frame.py, place):
        is_listed = scope.node.id in reading.bodies and scope.node.id != here.node.id
        is_exact = (scope.py.source.path, problem.place) in reading.exact
        if not is_listed and not is_exact and problem.raises != _ASSERTION:
            yield problem.why


def _own(reader: BodyStatementReader, node: Node) -> Iterator[Node]:
    """The parts of a statement that no statement in it has, as far as these were read."""
    inner = [n for n in nodes_in(node) if n.id in reader.reading.listed and n.id != node.id]
    if not inner:
        yield node
        return
    yield from _heads(node)


def _heads(node: Node) -> Iterator[Node]:
    for child in named(node):
        if child.type in _CLAUSES:
            yield from _heads(child)
        elif child.type not in _BLOCKS:
            yield child
