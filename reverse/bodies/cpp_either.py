"""References of C++ that are bound to one of two places: `auto& x = c ? a : b;`.

What follows such a declaration is read twice, in both branches of an `if`: with the one place, and
with the other.
"""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_declared import DeclaratorParts, only_value, taken_apart
from rebsync.reverse.bodies.cpp_mailbox import has_mailbox
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_roots import specifiers_of
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.cpp_tree import part, text_of

_MOST = 5  # references behind such a one
_KEPT = frozenset({"static", "thread_local"})


def behind(
    reader: CppStatementReader, node: Node, rest: Sequence[Node]
) -> list[m.Statement] | None:
    """The statements behind such a declaration, with what decides; None for another statement."""
    can_be = has_mailbox(reader.scope) or reader.scope.open
    declared = _reference(node) if can_be else None
    value = only_value(declared) if declared is not None else None
    while value is not None and value.type == "parenthesized_expression":
        value = value.named_children[0]
    if declared is None or value is None or value.type != "conditional_expression":
        return None
    if sum(_reference(later) is not None for later in rest) > _MOST:
        return None  # each may double what follows
    ways = [resolve(reader.scope, part(value, w)) for w in ("consequence", "alternative")]
    places = [w for w in ways if isinstance(w, Variable)]
    if len(places) != len(ways) or len(set(map(_kind, places))) != 1:
        return None  # of two types, the value would be one of its own
    if declared.text != "auto":
        carried = reader.scope.carried(declared.type)
        if carried is None or (carried.type, carried.bits, carried.wide) != _kind(places[0]):
            return None
    return _both(reader, node, declared.name, part(value, "condition"), places, rest)


def _reference(node: Node) -> DeclaratorParts | None:
    """The only name that a declaration gives, if it is a reference."""
    declarators = node.children_by_field_name("declarator") if node.type == "declaration" else []
    type_ = node.child_by_field_name("type")
    if type_ is None or len(declarators) != 1 or _KEPT & set(specifiers_of(node)):
        return None
    declared = taken_apart(declarators[0], type_, text_of(type_), False)
    return declared if declared.kind == "reference_declarator" else None


def _kind(place: Variable) -> tuple[m.Type | None, int, int]:
    return place.type, place.bits, place.wide


def _both(
    reader: CppStatementReader,
    node: Node,
    name: str,
    condition: Node,
    places: Sequence[Variable],
    rest: Sequence[Node],
) -> list[m.Statement] | None:
    around, reader.before = reader.before, []
    try:
        chosen = reader.expressions.condition(condition)
        needed = reader.before
    except Unread:
        return None  # it is listed as one that the model has not
    finally:
        reader.before = around
    outside, span, ways = reader.scope, reader.cpp.span(node), []
    for place in places:
        reader.meaning(name, place)
        ways.append(m.Block(tuple(reader.statements(rest)), (), span))
        reader.scope = outside
    return [*needed, m.If(chosen, ways[0], ways[1], (), span)]
