"""Targets of Python besides names: what is found on the way to them runs, and may be the node."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.findings import Unread
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Frame, Var
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_variables import outside
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_worth import Instance
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

_SEVERAL = frozenset(
    {"pattern_list", "tuple_pattern", "list_pattern", "list_splat_pattern", "expression_list"}
    | {"parenthesized_expression", "as_pattern_target", "tuple", "list"}
)


def places(target: Node) -> Iterator[Node]:
    """What a target stores in: the places of a pattern, or itself."""
    if target.type not in _SEVERAL:
        yield target
    for inner in named(target) if target.type in _SEVERAL else []:
        yield from places(inner)


def check_target(reader: BodyStatementReader, target: Node) -> None:
    """Refuses a target on whose way something runs, or that is the node's by another name."""
    for place in places(target):
        if not is_path(place):
            outside(reader, place, place)
        if place.type == "attribute" and _may_be_of_node(reader.reading, place, reader.frame):
            why = f'"{text_of(field(place, "object"))}" may be a node by another name'
            raise Unread(reader.frame.span(place), why)


def check_deleted(reader: BodyStatementReader, target: Node) -> None:
    """Refuses to delete what the model has: who reads it then ends by an exception."""
    check_target(reader, target)
    for place in places(target):
        if place.type == "attribute" and isinstance(reader.expressions.meaning(place)[0], Var):
            why = f'nothing has "{text_of(place)}" from here on'
            raise Unread(reader.frame.span(place), why)


def is_path(place: Node) -> bool:
    """Whether a target is a name, or an attribute of one: `a`, `a.b.c`."""
    while place.type == "attribute":
        place = field(place, "object")
    return place.type == "identifier"


def _may_be_of_node(reading: Reading, place: Node, frame: Frame) -> bool:
    """Whether an attribute is one that a node has, and not of the object whose method this is."""
    holder = field(place, "object")
    if text_of(holder) == frame.scope.self_name:
        return False
    name = text_of(field(place, "attribute"))
    return any(
        isinstance(way, Instance) and way.scope in reading.nodes and _has(reading, way.scope, name)
        for way in reading.values.ways(holder, frame.scope)
    )


def _has(reading: Reading, owner: Scope, name: str) -> bool:
    """Whether a class, or one above it that is in the files, binds an attribute."""
    above = (each for each in lineage(reading.values, owner) if isinstance(each, Scope))
    return any(name in each.attributes or name in each.names for each in above)
