"""`match` on values that stand in the code: texts and whole numbers."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.building import binary, is_calm
from rebsync.reverse.findings import Unread
from rebsync.reverse.python.body_scope import Value
from rebsync.reverse.python.py_tree import field, named, text_of

if TYPE_CHECKING:
    from rebsync.reverse.python.body_expression_reader import BodyExpressionReader

# A branch: what is asked (None: nothing), and the block that then runs; first the node of both.
Way: TypeAlias = "tuple[Node, Callable[[], m.Expression] | None, Node]"
_VALUES = frozenset({"string", "concatenated_string", "integer"})


def ways(reader: BodyExpressionReader, node: Node) -> list[Way]:
    """The branches of a `match`, up to the first that takes everything.

    Unread: a pattern binds names, or looks into a container or an object.
    """
    subjects = node.children_by_field_name("subject")
    if len(subjects) != 1:
        raise _unread(reader, node)
    subject = reader.read(subjects[0])
    if not is_calm(subject.expression):
        raise _unread(reader, node)
    found: list[Way] = []
    for clause in (c for c in named(field(node, "body")) if c.type == "case_clause"):
        body, guard = field(clause, "consequence"), clause.child_by_field_name("guard")
        patterns = [p for p in named(clause) if p.type == "case_pattern"]
        values = _values(reader, patterns)
        if values is None and guard is None:
            return [*found, (clause, None, body)]
        found.append((clause, partial(_asked, reader, subject, values, guard), body))
    return found


def _values(reader: BodyExpressionReader, patterns: list[Node]) -> list[Node] | None:
    """The values of a pattern, one of which the subject is to be; None: any at all."""
    if len(patterns) != 1:
        raise _unread(reader, patterns[0].parent or patterns[0])
    (pattern,) = patterns
    if text_of(pattern) == "_":
        return None
    inner = named(pattern)
    values = named(inner[0]) if len(inner) == 1 and inner[0].type == "union_pattern" else inner
    if not values or "-" in text_of(pattern).partition('"')[0].partition("'")[0]:
        raise _unread(reader, pattern)
    if not all(value.type in _VALUES for value in values):
        raise _unread(reader, pattern)
    return values


def _asked(
    reader: BodyExpressionReader, subject: Value, values: list[Node] | None, guard: Node | None
) -> m.Expression:
    """Whether a branch is taken, if none above it is."""
    found: m.Expression | None = None
    for number, value in enumerate(values or ()):
        one = reader.compared("==", subject, reader.read(value), value, number)
        found = one if found is None else binary("||", found, one)
    if guard is None:
        assert found is not None
        return found
    asked = reader.condition(named(guard)[0])
    return asked if found is None else binary("&&", found, asked)


def _unread(reader: BodyExpressionReader, node: Node) -> Unread:
    return Unread(reader.frame.span(node), "such a match is not read")
