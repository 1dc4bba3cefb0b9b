"""Values that the model cannot know: choices among what they can be."""

from __future__ import annotations

import re
from collections.abc import Iterable

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import number_literal
from rebsync.reverse.syntax.cpp_tree import markers_above, markers_beside, markers_in, text_of
from rebsync.source import Span

HINT = "say which values it can have, beside it: // rebsync: domain 0..5 (or {1, 2, 7})"
_RANGE = re.compile(r"(-?\d+)\s*\.\.\s*(-?\d+)")
_MOST = 256


class Unknown(Unread):
    """A value that the model cannot know, of which reading it changes nothing."""

    def __init__(self, span: Span, why: str, hint: str = HINT) -> None:
        super().__init__(span, why, hint)


class Demote(Exception):
    """Locals of a body get values that the model cannot know: the body is to be read again.

    `names` are theirs, or those of fields: `message.data`.
    """

    def __init__(self, names: Iterable[str]) -> None:
        super().__init__()
        self.names = frozenset(names)


def domain_near(node: Node) -> tuple[m.Expression, ...] | None:
    """The values that a comment beside or above the statement of a node gives."""
    statement = node
    while statement.parent is not None and not _is_statement(statement):
        statement = statement.parent
    for marker in (*markers_above(statement), *markers_beside(statement), *_opening(statement)):
        kind, _, text = marker.partition(" ")
        if kind == "domain":
            return domain_of(text)
    return None


def _is_statement(node: Node) -> bool:
    return node.type.endswith(("_statement", "declaration", "_loop"))


def _opening(statement: Node) -> tuple[str, ...]:
    """The markers behind the brace that opens the body of a statement."""
    for field in ("consequence", "body"):
        body = statement.child_by_field_name(field)
        if body is not None and body.type == "compound_statement" and body.named_children:
            first = body.named_children[0]
            if first.type == "comment" and first.start_point[0] == body.start_point[0]:
                return markers_in([text_of(first)])
    return ()


def domain_of(text: str) -> tuple[m.Expression, ...] | None:
    """`0..5`, `{1, 2, 7}`, `{true, false}` or `{0.5, 1.5}` as literals; None if it is none."""
    match = _RANGE.match(text.strip())
    if match is not None:
        first, last = int(match[1]), int(match[2])
        if not first <= last < first + _MOST:
            return None
        return tuple(number_literal(n) for n in range(first, last + 1))
    listed = text.strip().partition("}")[0].strip("{ ").split(",")
    values = [_value(piece.strip()) for piece in listed]
    known = tuple(dict.fromkeys(v for v in values if v is not None))
    return known if len(known) == len(values) <= _MOST else None


def _value(text: str) -> m.Expression | None:
    if text in ("true", "false"):
        return m.BoolLiteral(text == "true")
    if re.fullmatch(r"-?\d+", text):
        return number_literal(int(text))
    if re.fullmatch(r"-?\d+\.\d*", text):
        positive = m.FloatLiteral(f"{text.lstrip('-')}d")
        return m.Unary("-", positive) if text.startswith("-") else positive
    return None


def choice(values: tuple[m.Expression, ...]) -> m.Expression:
    """One of several values; the value if there is only one."""
    return values[0] if len(values) == 1 else m.Choice(values)
