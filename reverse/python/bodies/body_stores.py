"""Variables of Python that get values: assignments, of state, of locals, of fields of messages."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.models.texts import no_text
from rebsync.reverse.python.bodies import (
    body_copies,
    body_messages,
    body_methods,
    body_setup,
    body_switches,
    body_together,
)
from rebsync.reverse.python.bodies.body_effects import is_still, may_be_of_message
from rebsync.reverse.python.bodies.body_reading import field_key
from rebsync.reverse.python.bodies.body_scope import Message, Var
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_targets import check_target
from rebsync.reverse.python.bodies.body_variables import change, forget, give, outside
from rebsync.reverse.python.expressions.values import OTHER, STRING, Value
from rebsync.reverse.syntax.py_tree import field, named, text_of

_CONTAINERS = frozenset({"dictionary", "list", "tuple"})
_PLACES = frozenset({"identifier", "attribute"})


def assignment(reader: BodyStatementReader, node: Node) -> Iterator[m.Statement]:
    """`target = value`; several targets get it from left to right."""
    targets = [field(node, "left")]
    value = node.child_by_field_name("right")
    while value is not None and value.type == "assignment":
        targets.append(field(value, "left"))
        value = value.child_by_field_name("right")
    if value is None:
        return
    for target in targets:
        check_target(reader, target)
    if value.type == "call":
        known = body_setup.asked(reader, value)
        if known is not None:
            yield from known
            if len(targets) == 1:
                yield from body_copies.made(reader, targets[0])
            return
    if value.type in _CONTAINERS and len(targets) == 1 and targets[0].type in _PLACES:
        yield from _contained(reader, targets[0], value, node)
        return
    if len(targets) > 1 and value.type not in body_together.LITERALS:
        yield from body_together.chained(reader, targets, value, node)
        return
    for target in targets:
        yield from _assigned(reader, target, value, node)


def _assigned(
    reader: BodyStatementReader, target: Node, value: Node, node: Node
) -> Iterator[m.Statement]:
    if target.type in ("pattern_list", "tuple_pattern", "list_pattern"):
        yield from _unpacked(reader, target, value, node)
        return
    if target.type not in ("identifier", "attribute"):
        outside(reader, value, node)
        return
    learnt = reader.reading.learnt
    since = len(learnt.answers)
    meaning, path = reader.expressions.meaning(target)
    type_ = reader.reading.message_type(value, reader.frame)
    if isinstance(meaning, Message) and not path:
        body_copies.replaced(reader, meaning, target)
    if isinstance(meaning, Var | Message) and not path and not getattr(meaning, "server", ""):
        known = _kept(reader, meaning, target, value)
        if known is not None:
            yield from known
            return
    if value.type in ("identifier", "attribute") and body_together.is_changed(
        reader, target, value
    ):
        raise Unread(reader.frame.span(node), "another name for an object that is changed")
    match meaning:
        case Var(key) | Message(key, _, _, _, "") if not path and type_ is not None:
            learnt.join(key, type_)
            learnt.settle(key, since)
            meaning, _ = reader.expressions.meaning(target)
            reader.frame.assigned.add(text_of(target))
            if isinstance(meaning, Message):
                yield from body_messages.made(reader, meaning, value)
                yield from body_copies.presence(reader, meaning, m.BoolLiteral(True), target)
        case Var():
            yield from _variable(reader, meaning, target, value, node, since)
        case Message(server="") if path:
            yield from _field(reader, meaning, path, value, node)
        case Message() if path:
            outside(reader, value, node)
            change(reader, meaning, path)
        case Message(key):
            learnt.join(key, OTHER)
            outside(reader, value, node)
        case _:
            if may_be_of_message(reader.reading, target, reader.frame):
                why = "this may be a field of a message that has another name as well"
                raise Unread(reader.frame.span(node), why)
            known = _stepped(reader, target, body_methods.returned(reader, value), value)
            if known is None:
                outside(reader, value, node)
            yield from known or ()


def _contained(
    reader: BodyStatementReader, target: Node, value: Node, node: Node
) -> Iterator[m.Statement]:
    """A list, tuple or dictionary, of which the model has nothing but what is made in it."""
    for each in named(value):
        inner = field(each, "value") if each.type == "pair" else each
        made = body_setup.asked(reader, inner) if inner.type == "call" else None
        if made is not None:
            yield from made
        else:
            outside(reader, each, node)
    forget(reader, target)


def _kept(
    reader: BodyStatementReader, variable: Var | Message, target: Node, value: Node
) -> Iterator[m.Statement] | None:
    """The statements where a variable gets a message that there is, or None; else None."""
    if value.type == "none":
        body_switches.lost(reader, target)
        return body_copies.none(reader, variable, target)
    node = body_copies.original(reader.expressions, value)
    returned = body_methods.returned(reader, node)
    if returned is not None:
        first, inner, given = returned
        if body_copies.type_of(inner.expressions, given) is None:
            return _stepped(reader, target, returned, value)
        return chain(first, body_copies.kept(reader, target, inner, given, value))
    if node.type == "call" or body_copies.type_of(reader.expressions, node) is None:
        return None
    return body_copies.kept(reader, target, reader, node, value)


def _stepped(
    reader: BodyStatementReader, target: Node, returned: body_methods.Returned | None, call: Node
) -> Iterator[m.Statement] | None:
    """What a function does that changes the node, and then its value; None for other functions."""
    own = reader.reading.function(field(call, "function"), reader.frame)
    if returned is None or own is None or is_still(reader.reading, own):
        return None
    first, inner, given = returned
    variable, _ = reader.expressions.meaning(target)
    if isinstance(variable, Message):
        return None
    try:
        read = inner.expressions.read(given)
    except Unknown:
        outside(inner, given, given)
        forget(reader, target)
        return iter(first)
    if not isinstance(variable, Var):
        return iter(first) if is_calm(read.expression) else None
    return chain(first, give(reader, variable, text_of(target), read, call))


def _variable(
    reader: BodyStatementReader, variable: Var, target: Node, value: Node, node: Node, since: int
) -> Iterator[m.Statement]:
    if value.type == "none" and reader.reading.learnt.kind(variable.key) == STRING:
        nothing = Value(no_text(), STRING, mixed=True)
        yield from give(reader, variable, text_of(target), nothing, node)
        return
    before = reader.reading.extent
    try:
        read = reader.expressions.read(value)
    except Unknown:
        reader.reading.learnt.join(variable.key, OTHER)
        if reader.reading.extent == before:  # else trying to read the value has left something
            reader.reading.learnt.settle(variable.key, since)
        outside(reader, value, node)
        return
    yield from give(reader, variable, text_of(target), read, node)


def _field(
    reader: BodyStatementReader, message: Message, path: str, value: Node, node: Node
) -> Iterator[m.Statement]:
    fields = reader.reading.types.fields(message.type) or {}
    type_ = fields.get(path)
    if type_ is None or type_.dimensions:
        outside(reader, value, node)
        for each in fields:
            if each == path or each.startswith(f"{path}."):
                reader.reading.learnt.join(field_key(message, each), OTHER)
        return
    try:
        with body_messages.unless_text(reader.expressions, type_, value):
            read = reader.expressions.read(value)
            body_messages.as_field(reader.expressions, read, message.type, path, value)
    except Unknown:
        reader.reading.learnt.join(field_key(message, path), OTHER)
        outside(reader, value, node)
        return
    yield from body_messages.set_field(reader, message, path, read, node)


def _unpacked(
    reader: BodyStatementReader, target: Node, value: Node, node: Node
) -> Iterator[m.Statement]:
    """`a, b = b, a`: all values are there before the first target gets one."""
    targets = named(target)
    values = named(value) if value.type in ("expression_list", "tuple", "list") else []
    if len(values) == len(targets) and all(t.type in _PLACES for t in targets):
        if all(v.type in body_together.LITERALS for v in values):
            for one, other in zip(targets, values, strict=True):
                yield from _assigned(reader, one, other, node)
        else:
            yield from body_together.unpacked(reader, targets, values, node)
        return
    outside(reader, value, node)
    for inner in targets:
        forget(reader, inner)


def augmented(reader: BodyStatementReader, node: Node) -> Iterator[m.Statement]:
    target, value = field(node, "left"), field(node, "right")
    operator = text_of(field(node, "operator")).removesuffix("=")
    check_target(reader, target)
    meaning, path = reader.expressions.meaning(target)
    try:
        if not isinstance(meaning, (Var, Message)):
            raise Unknown(reader.frame.span(node), "it is not in the model")
        before = reader.expressions.read(target)
        read = reader.expressions.operation(operator, before, reader.expressions.read(value), node)
    except Unknown:
        forget(reader, target)
        outside(reader, node, node)
        return
    if isinstance(meaning, Var):
        yield from give(reader, meaning, text_of(target), read, node)
    elif meaning.server:
        outside(reader, value, node)
        change(reader, meaning, path)
    else:
        body_messages.as_field(reader.expressions, read, meaning.type, path, node)
        yield from body_messages.set_field(reader, meaning, path, read, node)
