"""Assignments to variables of the model whose value is read, or not known."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.python.bodies.body_effects import is_harmless
from rebsync.reverse.python.bodies.body_expressions import short
from rebsync.reverse.python.bodies.body_reading import field_key
from rebsync.reverse.python.bodies.body_scope import Message, Var
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.expressions.values import OTHER, REAL, TYPES, WHOLE, Value
from rebsync.reverse.syntax.py_tree import named


def change(reader: BodyStatementReader, message: Message, path: str) -> None:
    """A field of a message that came in is set: from its start nobody knows what it holds."""
    for each in reader.reading.types.fields(message.type) or {}:
        if each == path or each.startswith(f"{path}."):
            reader.reading.learnt.leave_open(reader.reading.unit.name, message.server, each)


def give(
    reader: BodyStatementReader, variable: Var, local: str, read: Value, node: Node
) -> Iterator[m.Statement]:
    """A variable gets a value."""
    reader.reading.learnt.join(variable.key, read.kind)
    if read.mixed:
        reader.reading.learnt.mix(variable.key)
    kind = reader.reading.learnt.kind(variable.key)
    if kind is None or kind == OTHER:
        if not is_calm(read.expression):
            raise Unread(reader.frame.span(node), "its value has effects, and it is of no type")
        return
    stored = read.expression
    if kind == REAL:
        stored = reader.expressions.real(read, node)
    elif kind == WHOLE:
        reader.reading.wide.add(variable.name)
        reader.reading.places[variable.name] = reader.frame.py.source, reader.frame.span(node)
    yield from store(reader, variable, TYPES[kind], stored, local, node)


def store(
    reader: BodyStatementReader,
    variable: Var,
    type_: m.Type,
    value: m.Expression,
    local: str,
    node: Node,
) -> Iterator[m.Statement]:
    """A variable of the model gets a value; a local is declared with its first one.

    Of a field of a message the variable has the key of the message. What a function sets for one
    around it is declared there, and may have had no value before.
    """
    span, name = reader.frame.span(node), variable.name
    frame = reader.frame.owner_of(variable.key) or reader.frame
    if frame is reader.frame:
        frame.assigned.add(local)
    if not variable.is_state and name not in frame.declared:
        frame.declared.add(name)
        if frame is reader.frame and not frame.depth:
            yield declared(name, type_, value)
            return
        frame.hoisted[name] = type_
    yield m.ExpressionStatement(m.Assign("=", m.Name(name), value, span), (), span)


def forget(reader: BodyStatementReader, target: Node) -> None:
    """A variable gets a value that nobody knows."""
    if target.type not in ("identifier", "attribute"):
        for inner in named(target) if target.type.endswith(("list", "tuple", "pattern")) else []:
            forget(reader, inner)
        return
    since = len(reader.reading.learnt.answers)
    meaning, path = reader.expressions.meaning(target)
    match meaning:
        case Var(key):
            reader.reading.learnt.join(key, OTHER)
            reader.reading.learnt.settle(key, since)
        case Message(key, _, type_, _, "") if path:
            for each in reader.reading.types.fields(type_) or {}:
                if each == path or each.startswith(f"{path}."):
                    reader.reading.learnt.join(field_key(meaning, each), OTHER)
        case Message() if path:
            change(reader, meaning, path)
        case Message(key):
            reader.reading.learnt.join(key, OTHER)
        case _:
            return


def outside(reader: BodyStatementReader, value: Node, node: Node) -> None:
    """A value that goes where the model has nothing."""
    if is_harmless(reader.reading, value, reader.frame):
        return
    raise Unread(reader.frame.span(node), f'what "{short(value)}" does is not known')


def declared(name: str, type_: m.Type, value: m.Expression | None) -> m.Statement:
    """`type name = value;`"""
    return m.Local(m.Declaration(type_, (m.Declarator(name, value),)))
