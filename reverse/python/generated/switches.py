"""An `if` chain that generated Python has for a `switch` of the model."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.python.generated import endings
from rebsync.reverse.python.generated.py_types import markers_above, without_parentheses
from rebsync.reverse.python.generated.statement_reader import ModelStatementReader
from rebsync.reverse.syntax.py_tree import field, named, text_of, whole_number_of
from rebsync.static.types import is_integer

_SWITCH = "switch"
_JUMPS = (m.Break, m.Continue, m.Return)


def switched(reader: ModelStatementReader, node: Node) -> m.Switch | None:
    """The switch that an `if` with the marker is; None where it is none any more.

    Then it is what it says, a chain: where it asks for something else than numbers of one variable,
    asks twice for one, or has a `break`, which would leave the loop around it.
    """
    if _SWITCH not in markers_above(reader.expressions.py, node):
        return None
    parts = [node, *node.children_by_field_name("alternative")]
    asked = [_asked(p) for p in parts if p.type != "else_clause"]
    subjects = {text_of(a[0]) for a in asked if a is not None}
    numbers = [text_of(n) for a in asked if a is not None for n in a[1]]
    if None in asked or len(subjects) != 1 or len(set(map(_value, numbers))) != len(numbers):
        return None
    bodies = [field(p, "body" if p.type == "else_clause" else "consequence") for p in parts]
    first = asked[0]
    if first is None or any(map(endings.leaves, bodies)):
        return None
    subject = reader.expressions.expression(first[0])
    if not isinstance(subject, m.Name) or not _is_integer(reader, subject):
        return None
    cases: list[m.Case] = []
    for number, (part, body) in enumerate(zip(parts, bodies, strict=True)):
        found = asked[number] if number < len(asked) else None
        cases += _cases(reader, part, body, found[1] if found is not None else [])
    return m.Switch(subject, tuple(cases), span=reader.expressions.py.span(node))


def _asked(part: Node) -> tuple[Node, list[Node]] | None:
    """The subject and the numbers of `x == 1` and of `x in (1, 2)`."""
    condition = without_parentheses(field(part, "condition"))
    parts = condition.named_children
    signs = [c.type for c in condition.children if not c.is_named]
    if condition.type != "comparison_operator" or len(parts) != 2:
        return None
    subject, right = parts
    numbers = [right] if signs == ["=="] else named(right)
    is_set = signs == ["=="] or (signs == ["in"] and right.type == "tuple")
    is_plain = subject.type in ("identifier", "attribute") and bool(numbers)
    return (subject, numbers) if is_set and is_plain and all(map(_is_number, numbers)) else None


def _is_number(node: Node) -> bool:
    if node.type == "unary_operator" and text_of(field(node, "operator")) == "-":
        node = field(node, "argument")
    return whole_number_of(node) is not None


def _value(text: str) -> int:
    return int(text.replace(" ", ""), 0)


def _is_integer(reader: ModelStatementReader, subject: m.Name) -> bool:
    kind = reader.expressions.kind(subject)
    return kind is not None and is_integer(kind)


def _cases(
    reader: ModelStatementReader, part: Node, body: Node, numbers: list[Node]
) -> list[m.Case]:
    """The cases of a branch: the first ones fall through to the last, which does what it does."""
    span = reader.expressions.py.span(part)
    values = [reader.expressions.expression(n) for n in numbers]
    statements = reader.branch(body).statements
    if values and not (statements and isinstance(statements[-1], _JUMPS)):
        statements = (*statements, m.Break(span=span))
    heads = [m.Case(v, (), span=span) for v in values[:-1]]
    last = values[-1] if values else None
    return [*heads, m.Case(last, statements, span=span)]
