"""The branches of `if` and `match`, with what is stored on the way to them.

`match` is read of values that stand in the code, and of names that take all.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import binary, is_calm
from rebsync.reverse.python.bodies.body_scope import TRUTH, Value, Var
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_together import is_object, kept
from rebsync.reverse.python.bodies.body_variables import forget, give, outside
from rebsync.reverse.syntax.py_tree import field, named, text_of

# What is stored before a branch is chosen, and what is asked; None: nothing, it is taken.
Asked: TypeAlias = "tuple[list[m.Statement], m.Expression | None]"
# A branch: what is asked, and the block that then runs; first the node of both.
Way: TypeAlias = "tuple[Node, Callable[[], Asked], Node]"
_VALUES = frozenset({"string", "concatenated_string", "integer", "float", "true", "false"})
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
        raise _unread(reader, node)
    value = _read(reader, subjects[0])
    clauses = [c for c in named(field(node, "body")) if c.type == "case_clause"]
    patterns = [p for c in clauses for p in named(c) if p.type == "case_pattern"]
    names = [p for p in patterns if text_of(p) != "_" and _pattern(reader, p)[0] is not None]
    if value is None or (is_calm(value.expression) and not names):
        return [], value
    return kept(reader, value, "subject", subjects[0])


def ways(reader: BodyStatementReader, node: Node, of: Value | None) -> list[Way]:
    """The branches of a `match`, up to the first that takes everything.

    Unread: a pattern binds several names, or looks into a container or an object.
    """
    found: list[Way] = []
    for clause in (c for c in named(field(node, "body")) if c.type == "case_clause"):
        guard = clause.child_by_field_name("guard")
        patterns = [p for p in named(clause) if p.type == "case_pattern"]
        if len(patterns) != 1:
            raise _unread(reader, clause)
        name, values = _pattern(reader, patterns[0])
        taken = partial(_asked, reader, of, name, values, guard)
        found.append((clause, taken, field(clause, "consequence")))
        if not values and guard is None:
            break
    return found


def _pattern(reader: BodyStatementReader, pattern: Node) -> tuple[Node | None, list[Node]]:
    """The name that takes everything, or the values one of which the subject is to be."""
    inner = named(pattern)
    if text_of(pattern) == "_":
        return None, []
    if len(inner) == 1 and inner[0].type == "dotted_name" and len(named(inner[0])) == 1:
        return named(inner[0])[0], []
    values = named(inner[0]) if len(inner) == 1 and inner[0].type == "union_pattern" else inner
    signs = text_of(pattern).partition('"')[0].partition("'")[0]
    if not values or not all(value.type in _VALUES for value in values):
        raise _unread(reader, pattern)
    if "-" in signs and (len(values) != 1 or values[0].type != "integer" or "+" in signs):
        raise _unread(reader, pattern)
    return None, [pattern] if "-" in signs else values


def _asked(
    reader: BodyStatementReader,
    of: Value | None,
    name: Node | None,
    values: list[Node],
    guard: Node | None,
) -> Asked:
    """Whether a branch is taken, if none above it is."""
    first = _stored(reader, name, of) if name is not None else []
    found: m.Expression | None = None
    if of is None and values:
        found = m.Choice((m.BoolLiteral(True), m.BoolLiteral(False)))
        values = []
    for number, value in enumerate(values):
        assert of is not None
        one = reader.expressions.compared("==", of, _value(reader, of, value), value, number)
        found = one if found is None else binary("||", found, one)
    if guard is None:
        return first, found
    held = reader.expressions.condition(named(guard)[0])
    return first, held if found is None else binary("&&", found, held)


def _value(reader: BodyStatementReader, of: Value, value: Node) -> Value:
    """A value of a pattern; True and False are looked for by identity."""
    if value.type == "case_pattern":
        number = reader.expressions.read(named(value)[0])
        return Value(m.Unary("-", number.expression), number.kind)
    if value.type in ("true", "false") and of.kind != TRUTH:
        raise _unread(reader, value)
    return reader.expressions.read(value)


def _unread(reader: BodyStatementReader, node: Node) -> Unread:
    return Unread(reader.frame.span(node), "such a match is not read")
