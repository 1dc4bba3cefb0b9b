"""The branches of `if` and `match`, with what is stored on the way to them."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.python.bodies.body_scope import Var
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_together import is_object, kept
from rebsync.reverse.python.bodies.body_variables import forget, give, outside
from rebsync.reverse.python.expressions import patterns
from rebsync.reverse.python.expressions.patterns import MatchCase, cases
from rebsync.reverse.python.expressions.values import Value
from rebsync.reverse.syntax.py_tree import field, named, text_of

# What is stored before a branch is chosen, and what is asked; None: nothing, it is taken.
Asked: TypeAlias = "tuple[list[m.Statement], m.Expression | None]"
# A branch: what is asked, and the block that then runs; first the node of both.
Way: TypeAlias = "tuple[Node, Callable[[], Asked], Node]"
# Expressions of which the first part is always evaluated, and first of all.
_FIRST = frozenset(
    {"comparison_operator", "parenthesized_expression", "boolean_operator", "binary_operator"}
    | {"not_operator"}
)


def asked(reader: BodyStatementReader, node: Node) -> Asked:
    """A condition. What it stores first of all, as `n` in `(n := f()) > 3`, is stored before."""
    at = node
    while at.type in _FIRST and named(at):
        at = named(at)[0]
    if at.type != "named_expression":
        return [], reader.expressions.condition(node)
    stored = _stored(reader, field(at, "name"), _read(reader, field(at, "value")))
    reader.reading.stored.add(at.id)
    try:
        return stored, reader.expressions.condition(node)
    finally:
        reader.reading.stored.discard(at.id)


def _read(reader: BodyStatementReader, node: Node) -> Value | None:
    """The value of an expression; None: nobody knows it, and it changes nothing."""
    try:
        return reader.expressions.read(node)
    except Unknown as open_:
        if is_object(reader, node, node):
            raise
        outside(reader, node, node)
        reader.expressions.note(node, open_.why)
        return None


def _stored(reader: BodyStatementReader, name: Node, value: Value | None) -> list[m.Statement]:
    if value is None:
        forget(reader, name)
        return []
    meaning, _ = reader.expressions.meaning(name)
    if not isinstance(meaning, Var):
        raise Unread(reader.frame.span(name), f'what "{text_of(name)}" is is not in the model')
    return list(give(reader, meaning, text_of(name), value, name))


def subject(reader: BodyStatementReader, node: Node) -> tuple[list[m.Statement], Value | None]:
    """What a `match` looks at, in a local where a name that takes it may change it."""
    subjects = node.children_by_field_name("subject")
    if len(subjects) != 1:
        raise Unread(reader.frame.span(node), "such a match is not read")
    value = _read(reader, subjects[0])
    names = [n for case in cases(reader.expressions, node) for n in case.names if n is not None]
    if value is None or (is_calm(value.expression) and not names):
        return [], value
    return kept(reader, value, "subject", subjects[0])


def ways(reader: BodyStatementReader, node: Node, of: Value | None) -> list[Way]:
    """The branches of a `match`."""
    found = cases(reader.expressions, node)
    return [(case.clause, partial(_asked, reader, of, case), case.block) for case in found]


def _asked(reader: BodyStatementReader, of: Value | None, case: MatchCase) -> Asked:
    """Whether a branch is taken, if none above it is."""
    first = [s for n in case.names if n is not None for s in _stored(reader, n, of)]
    return first, patterns.asked(reader.expressions, case, of)
