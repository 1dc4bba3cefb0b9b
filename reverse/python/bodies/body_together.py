"""Assignments of several variables at once: `a, b = b, a`, `a = b = value`.

All values are there before the first variable gets one: those that would change on the way are
kept in locals of the model.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.python.bodies import body_messages
from rebsync.reverse.python.bodies.body_effects import may_be_of_message
from rebsync.reverse.python.bodies.body_scope import Message, Nobody, Var
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_variables import forget, give, outside
from rebsync.reverse.python.expressions.values import OTHER, Value
from rebsync.reverse.syntax.py_tree import text_of

LITERALS = frozenset({"integer", "float", "true", "false", "none"})
_EMPTY = frozenset({"dictionary", "list", "tuple", "set"})


def chained(
    reader: BodyStatementReader, targets: Sequence[Node], value: Node, node: Node
) -> Iterator[m.Statement]:
    """`a = b = value`: several variables get one value, from left to right."""
    if value.type in _EMPTY or any(t.type not in ("identifier", "attribute") for t in targets):
        raise Unread(reader.frame.span(node), "several variables get one value")
    read = _value(reader, value, node)
    if read is None and any(is_object(reader, target, value) for target in targets):
        raise Unread(reader.frame.span(node), "several variables get one object")
    changed = {name for target in targets for name in _changed(reader, target)}
    if read is not None and _needs_local(read, changed):
        first, read = kept(reader, read, "value", value)
        yield from first
    for target in targets:
        yield from _given(reader, target, read, node)


def unpacked(
    reader: BodyStatementReader, targets: Sequence[Node], values: Sequence[Node], node: Node
) -> Iterator[m.Statement]:
    """`a, b = value, other`."""
    found = [_value(reader, value, node) for value in values]
    for target, value, read in zip(targets, values, found, strict=True):
        if read is None and is_object(reader, target, value):
            raise Unread(reader.frame.span(node), "what these variables get is not in the model")
    changed: set[str] = set()
    for number, (target, read) in enumerate(zip(targets, found, strict=True)):
        if read is not None and _needs_local(read, changed):
            first, found[number] = kept(reader, read, text_of(target), values[number])
            yield from first
        changed |= _changed(reader, target)
    for target, read in zip(targets, found, strict=True):
        yield from _given(reader, target, read, node)


def kept(
    reader: BodyStatementReader, value: Value, wish: str, node: Node
) -> tuple[list[m.Statement], Value]:
    """A value that is stored in a local of the model, and that local."""
    key = "local", node.id, wish
    variable = Var(key, reader.reading.fresh(wish.rpartition(".")[2], key), False)
    stored = list(give(reader, variable, wish, value, node))
    kind = reader.reading.learnt.kind(key)
    if kind is None or kind == OTHER:
        raise Unread(reader.frame.span(node), "what this is may be of several types")
    return stored, Value(m.Name(variable.name), kind, mixed=value.mixed)


def _value(reader: BodyStatementReader, value: Node, node: Node) -> Value | None:
    """The value that an expression has before anything is stored; None: nobody knows it."""
    try:
        return reader.expressions.read(value)
    except Unknown:
        outside(reader, value, node)
        return None


def is_object(reader: BodyStatementReader, target: Node, value: Node) -> bool:
    """Whether a value may be an object that the model has: a message, or None instead of one."""
    if value.type == "call":
        return reader.reading.message_type(value, reader.frame) is not None
    is_open = isinstance(reader.expressions.meaning(value)[0], Nobody | Var)
    return value.type == "none" or not is_open or is_changed(reader, target, value)


def is_changed(reader: BodyStatementReader, *names: Node) -> bool:
    """Whether code sets fields of what has one of some names, other than the object itself."""
    holders = {text_of(name) for name in names} - {reader.frame.scope.self_name, "self"}
    code = reader.reading.code
    scopes = (*code.scopes.values(), *code.modules.values())
    return any(holder.partition("[")[0] in holders for s in scopes for holder, _ in s.stores)


def _needs_local(value: Value, changed: Set[str]) -> bool:
    """Whether a value is another one after some variables of the model are changed."""
    names = {n.name for n in m.walk(value.expression) if isinstance(n, m.Name)}
    return bool(names & changed) or not is_calm(value.expression)


def _changed(reader: BodyStatementReader, target: Node) -> set[str]:
    """The variable of the model that a target is."""
    meaning, path = reader.expressions.meaning(target)
    match meaning:
        case Var(_, name):
            return {name}
        case Message(server="") if path:
            return {reader.reading.field_name(meaning, path, target, reader.frame)}
        case _:
            return set()


def _given(
    reader: BodyStatementReader, target: Node, read: Value | None, node: Node
) -> Iterator[m.Statement]:
    meaning, path = reader.expressions.meaning(target)
    match meaning:
        case Var() if read is not None:
            yield from give(reader, meaning, text_of(target), read, node)
        case Message(server="") if read is not None and _is_single(reader, meaning, path):
            body_messages.as_field(reader.expressions, read, meaning.type, path, node)
            yield from body_messages.set_field(reader, meaning, path, read, node)
        case Var():
            forget(reader, target)
        case Nobody() if not may_be_of_message(reader.reading, target, reader.frame):
            pass
        case _:
            raise Unread(reader.frame.span(node), "what these variables get is not in the model")


def _is_single(reader: BodyStatementReader, message: Message, path: str) -> bool:
    """Whether a path is that of one number, truth value or text of a message."""
    type_ = (reader.reading.types.fields(message.type) or {}).get(path)
    return type_ is not None and not type_.dimensions
