"""Locals of generated Python that are records: `cell = Cell(x, y)` is a local for each field.

A record may be changed, so that only its fields may be read, and it may be called nothing else.
A tuple, whose fields are numbered, does not change: it is only bound once.
"""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.python.generated.inner import is_shown
from rebsync.reverse.python.generated.record_classes import fields_of, given_to, is_tuple
from rebsync.reverse.python.generated.statement_reader import ModelStatementReader
from rebsync.reverse.python.generated.tuples import parts
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import SCOPES, field, is_label, named, text_of

_TARGETS = frozenset(
    {
        *("pattern_list", "tuple_pattern", "list_pattern", "as_pattern_target", "dotted_name"),
        *("delete_statement", "global_statement", "nonlocal_statement", "aliased_import"),
        *("parameters", "typed_parameter", "default_parameter", "typed_default_parameter"),
        *("expression_list", "list_splat", "list_splat_pattern", "dictionary_splat"),
    }
)


def behind(reader: ModelStatementReader, node: Node, rest: list[Node]) -> list[m.Statement] | None:
    """The statements of one that makes a local record, and behind it; None if it does not."""
    inner = named(node)[0] if node.type == "expression_statement" and named(node) else node
    value = inner.child_by_field_name("right") if inner.type == "assignment" else None
    if value is None or field(inner, "left").type != "identifier":
        return None
    name = text_of(field(inner, "left"))
    made, own = _made_of(reader, value), reader.expressions
    if made is None or not _is_only_read(inner, name, made.labels):
        return None
    if any(f"{name}_{f}" in own.locals for f, _ in made.given):
        return None
    found: list[m.Statement] = [_local(reader, f"{name}_{f}", v, node) for f, v in made.given]
    local = [own.value(m.Name(reader.local(f"{name}_{f}"))) for f in made.fields]
    with own.standing_for([f"{name}.{label}" for label in made.labels], local * made.ways):
        return [*found, *reader.block(rest, node).statements]


@dataclass(frozen=True, slots=True)
class _Made:
    """A record: its fields, what they are given in the order of evaluation, and what reads them.

    Those of a named tuple are read by their numbers as well.
    """

    fields: Sequence[str]
    given: Sequence[tuple[str, Node | m.Expression]]
    labels: Sequence[str]

    @property
    def ways(self) -> int:
        return len(self.labels) // len(self.fields)


def _made_of(reader: ModelStatementReader, value: Node) -> _Made | None:
    called = text_of(field(value, "function")) if value.type == "call" else ""
    if fields := fields_of(reader.expressions, called):
        given = given_to(value, fields)
        numbers = [*map(str, range(len(fields)))] if is_tuple(reader.expressions, called) else []
        return _Made(fields, given, [*fields, *numbers]) if given else None
    if is_shown(reader.expressions, value):
        return None
    values = named(value) if value.type == "tuple" else _chosen(reader, value)
    numbers = [*map(str, range(len(values or ())))]
    return _Made(numbers, [*zip(numbers, values, strict=True)], numbers) if values else None


def _chosen(reader: ModelStatementReader, value: Node) -> Sequence[Node | m.Expression] | None:
    """The elements of a tuple that a condition or a table chooses."""
    is_one = value.type in ("conditional_expression", "call", "subscript")
    return parts(reader.expressions, value, arrays=False) if is_one else None


def _local(
    reader: ModelStatementReader, name: str, value: Node | m.Expression, node: Node
) -> m.Local:
    if isinstance(value, Node):
        return reader.implied_local(name, value, node)
    type_ = reader.expressions.kind(value)
    if type_ is None:
        raise reader.expressions.unread(node, "say these values one by one")
    return reader.declaration(name, reader.local(name), type_, value, node)


def _is_only_read(assignment: Node, name: str, fields: Sequence[str]) -> bool:
    """Whether a local is bound once, and else only read: a record its fields, in the function."""
    function = climb(assignment, lambda n: n.type in SCOPES)
    if function is None:
        return False
    uses = [n for n in nodes_in(function) if n.type == "identifier" and text_of(n) == name]
    others = [n for n in uses if n != field(assignment, "left") and not is_label(n)]
    taken = {f"{name}_{each}" for each in fields}
    if any(n.type == "identifier" and text_of(n) in taken for n in nodes_in(function)):
        return False
    return all(_is_read(n, function, fields) for n in others)


def _is_read(use: Node, function: Node, fields: Sequence[str]) -> bool:
    node, above = use, use.parent
    if "0" not in fields:
        if above is None or text_of(above.child_by_field_name("attribute") or use) not in fields:
            return False
        node, above = above, above.parent
    elif above is not None and above.type in ("subscript", "attribute"):
        node, above = above, above.parent
    is_target = above is None or above.type in _TARGETS
    if above is not None and above.type in _STORING:
        stored = (above.children_by_field_name(n) for n in ("left", "function", "name"))
        is_target = any(node in each for each in stored)
    return not is_target and climb(use, lambda n: n.type in SCOPES) == function


_STORING = frozenset(
    {
        *("assignment", "augmented_assignment", "for_statement", "for_in_clause", "call"),
        "named_expression",
    }
)
