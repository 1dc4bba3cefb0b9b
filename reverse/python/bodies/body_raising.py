"""What exceptions may leave statements of people's Python: the callback ends there, or the node.

The model has no exceptions. What it has of a statement raises none; neither does what a function
raises that stands in the place of its call, where that is listed.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync.reverse.analysis.problems import Problem
from rebsync.reverse.analysis.python.call_binding import REFUSED
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import named
from rebsync.source import Span

if TYPE_CHECKING:
    from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader

_ASSERTION = "builtins.AssertionError"  # the model has assertions


def raised(reader: BodyStatementReader, node: Node) -> str | None:
    """What a statement that was read may raise beside those in it; None if that is nothing."""
    if reader.reading.form is None:
        return None
    for part in _own(reader, node):
        why = next(_raised(reader, reader.frame.span(part)), None)
        if why is not None:
            return why
    return None


def is_raised_in(reader: BodyStatementReader, block: Node) -> bool:
    """Whether something in a block may raise an exception, whether or not that is handled."""
    form = reader.reading.form
    if form is None:
        return True
    problems = form.raising(reader.frame.py, reader.frame.span(block))
    return any(not _is_exact(reader, p, s) for p, s in problems)


def _raised(reader: BodyStatementReader, place: Span) -> Iterator[str]:
    form = reader.reading.form
    assert form is not None
    here = reader.frame.scope
    for problem, scope in form.raised(reader.frame.py, place):
        is_elsewhere = scope.node.id != here.node.id and not problem.is_of_call
        is_listed = is_elsewhere and _is_read(reader, scope, problem.place)
        is_exact = _is_exact(reader, problem, scope)
        if not is_listed and not is_exact and problem.raises != _ASSERTION:
            yield problem.why


def _is_exact(reader: BodyStatementReader, problem: Problem, scope: Scope) -> bool:
    """Whether the model has the operation that a problem is of, which is shown to raise nothing.

    Of a call it has what the function does, not whether the function takes the arguments.
    """
    is_there = (scope.py.source.path, problem.place) in reader.reading.exact
    return is_there and not problem.why.endswith(REFUSED)


def _is_read(reader: BodyStatementReader, function: Scope, place: Span) -> bool:
    """Whether the statement at a place in a function was read, so that what it raises is there."""
    body = function.node.child_by_field_name("body")
    listed = reader.reading.listed
    if body is None or not any(n.id in listed for n in (body, *named(body))):
        return False
    around = _statement_at(function, body, place)
    return around is None or around.id in listed


def _statement_at(function: Scope, body: Node, place: Span) -> Node | None:
    """The innermost statement at a place in a body."""
    found = None
    waiting = [body]
    while waiting:
        node = waiting.pop()
        for child in named(node):
            span = function.py.span(child)
            if span.holds(place):
                found = child if node.type == "block" else found
                waiting.append(child)
    return found


def _own(reader: BodyStatementReader, node: Node) -> Iterator[Node]:
    """The parts of a statement that no statement in it has, as far as these were read."""
    if not any(n.id in reader.reading.listed and n.id != node.id for n in nodes_in(node)):
        yield node
    elif node.type != "block":
        for child in named(node):
            yield from _own(reader, child)
