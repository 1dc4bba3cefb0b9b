"""Messages that variables keep: copies of what came in, or of what a function returned, or None.

A variable that holds a message has a variable of the model for each of its fields that something
reads. In Python it is another name for the object, so that a message that is changed elsewhere is
not read. Whether there is one yet is a truth value, where the variable holds None at times.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import Unread
from rebsync.reverse.python.bodies import body_messages
from rebsync.reverse.python.bodies.body_expression_reader import BodyExpressionReader
from rebsync.reverse.python.bodies.body_presence import is_there, presence_key, presence_name
from rebsync.reverse.python.bodies.body_reading import Reading, field_key
from rebsync.reverse.python.bodies.body_scope import Frame, Message, Var
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_variables import store
from rebsync.reverse.python.expressions.values import OTHER, TRUTH, TYPES
from rebsync.reverse.python.values.interfaces import interface_of
from rebsync.reverse.python.values.py_worth import External
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import CLASS, Scope, arguments_of
from rebsync.reverse.syntax.py_tree import field, text_of

_ROOT = re.compile(r"(?:(\w+)\.)?(\w+)")
_COPY = "copy.copy"
_DEEP = "copy.deepcopy"
_LOOPS = frozenset({"for_statement", "while_statement"})
_FUNCTIONS = frozenset({"function_definition", "lambda", "module"})
_CHANGED = "another name for a message that may be changed"


def original(reader: BodyExpressionReader, value: Node) -> Node:
    """The expression that gives a message, without what copies it."""
    if value.type == "call":
        plain, keywords = arguments_of(value)
        name = reader.reading.external(field(value, "function"), reader.frame)
        if name in (_COPY, _DEEP) and len(plain) == 1 and not keywords:
            return plain[0]
    return value


def type_of(reader: BodyExpressionReader, node: Node) -> str | None:
    """The type of the message that an expression gives: a new one, or one in a variable."""
    made = reader.reading.message_type(node, reader.frame)
    if made is not None or node.type not in ("identifier", "attribute"):
        return made
    meaning, path = reader.meaning(node)
    return meaning.type if isinstance(meaning, Message) and not path else None


def kept(
    reader: BodyStatementReader, target: Node, source: BodyStatementReader, node: Node, value: Node
) -> Iterator[m.Statement]:
    """`target = value`: a variable gets the message that `node` gives where `source` reads.

    Unread: a change of the message would be seen through both names.
    """
    type_ = type_of(source.expressions, node)
    assert type_ is not None
    learnt = reader.reading.learnt
    since = len(learnt.answers)
    meaning, _ = reader.expressions.meaning(target)
    assert isinstance(meaning, Var | Message)
    if (
        node.type != "call"
        and not _is_deep(reader, value)
        and _may_change(source, node, target, type_)
    ):
        raise Unread(reader.frame.span(target), _CHANGED)
    learnt.join(meaning.key, type_)
    learnt.settle(meaning.key, since)
    reader.frame.assigned.add(text_of(target))
    now, _ = reader.expressions.meaning(target)
    if isinstance(now, Message):
        yield from copied(reader, now, source, node)
        yield from _passed_on(reader, now, source, node, target)


def _is_deep(reader: BodyStatementReader, value: Node) -> bool:
    """Whether a value is a copy with all that is in it."""
    if value.type != "call":
        return False
    return reader.reading.external(field(value, "function"), reader.frame) == _DEEP


def copied(
    reader: BodyStatementReader, message: Message, source: BodyStatementReader, node: Node
) -> Iterator[m.Statement]:
    """The fields of a message in a variable that something reads get those of another."""
    learnt = reader.reading.learnt
    for path, type_ in (reader.reading.types.fields(message.type) or {}).items():
        if type_ is None or type_.dimensions:
            continue
        key = field_key(message, path)
        if not learnt.is_wanted(key) and learnt.kind(key) is None:
            continue
        if learnt.kind(key) == OTHER:
            continue
        try:
            with body_messages.unless_text(source.expressions, type_, node):
                value = body_messages.field_of(source.expressions, node, message.type, path)
                if node.type == "call":
                    body_messages.as_field(source.expressions, value, message.type, path, node)
        except Unknown:
            learnt.join(key, OTHER)
            continue
        yield from body_messages.set_field(reader, message, path, value, reader.root)


# --- None ---------------------------------------------------------------------------------------


def presence(
    reader: BodyStatementReader, variable: Var | Message, is_there_: m.Expression, node: Node
) -> Iterator[m.Statement]:
    """A variable holds a message or timer, or None."""
    key = presence_key(variable.key)
    learnt = reader.reading.learnt
    if learnt.kind(key) is not None and learnt.is_wanted(key):
        name = presence_name(reader.expressions, variable, node)
        whole = Var(variable.key, name, variable.is_state)
        yield from store(reader, whole, TYPES[TRUTH], is_there_, key[2], node)


def _passed_on(
    reader: BodyStatementReader,
    variable: Message,
    source: BodyStatementReader,
    node: Node,
    target: Node,
) -> Iterator[m.Statement]:
    """A variable that gets what another holds has a message if that has one, as it is now."""
    key = presence_key(variable.key)
    learnt = reader.reading.learnt
    found = is_there(source.expressions, node) if learnt.is_wanted(key) else None
    if isinstance(found, m.Name):
        learnt.join(key, TRUTH)
    yield from presence(reader, variable, found or m.BoolLiteral(True), target)


def made(reader: BodyStatementReader, target: Node) -> Iterator[m.Statement]:
    """A variable gets a timer."""
    if target.type in ("identifier", "attribute"):
        meaning, path = reader.expressions.meaning(target)
        if isinstance(meaning, Var) and not path and meaning.is_state:
            yield from presence(reader, meaning, m.BoolLiteral(True), target)


def none(
    reader: BodyStatementReader, variable: Var | Message, target: Node
) -> Iterator[m.Statement] | None:
    """A state variable gets None; None for one that holds values of the model."""
    learnt = reader.reading.learnt
    if not variable.is_state or (isinstance(variable, Var) and learnt.kind(variable.key)):
        return None
    learnt.join(presence_key(variable.key), TRUTH)
    return presence(reader, variable, m.BoolLiteral(False), target)


# --- other names for an object ------------------------------------------------------------------


def replaced(reader: BodyStatementReader, variable: Message, target: Node) -> None:
    """A variable of messages is about to hold another object.

    Unread: a parameter of a function that is under way stands for what it held before.
    """
    frame: Frame | None = reader.frame
    while frame is not None:
        if any(isinstance(b, Message) and b.key == variable.key for b in frame.bound.values()):
            why = "a function that was given the message here before still runs"
            raise Unread(reader.frame.span(target), why)
        frame = frame.outer


def _may_change(source: BodyStatementReader, node: Node, target: Node, type_: str) -> bool:
    """Whether a message that has two names may be changed through one of them.

    Not by what only a function's own new message gets, nor before it has its second name.
    """
    reading, frame = source.reading, source.frame
    fields = {word for path in reading.types.fields(type_) or {} for word in path.split(".")}
    names = {text_of(node), text_of(target)}
    code = reading.code
    for scope in (*code.scopes.values(), *code.modules.values()):
        for (holder, name), bindings in scope.stores.items():
            if name not in fields:
                continue
            is_named = any(_is_below(holder, each) for each in names)
            if is_named and scope is frame.scope and _are_before(bindings, holder, node):
                continue
            if is_named or not _is_new(reading, scope, holder):
                return True
    return False


def _is_below(holder: str, name: str) -> bool:
    return holder == name or holder.startswith((f"{name}.", f"{name}["))


def _are_before(bindings: list[Binding], holder: str, node: Node) -> bool:
    """Whether a local message gets its fields before an expression that names it."""
    if node.type != "identifier" or not _is_below(holder, text_of(node)):
        return False
    around = ancestors(node, lambda n: n.type in _FUNCTIONS)
    return not any(n.type in _LOOPS for n in around) and all(
        b.node.end_byte <= node.start_byte for b in bindings
    )


def _is_new(reading: Reading, scope: Scope, holder: str) -> bool:
    """Whether a variable holds nothing but messages that are made for it."""
    match = _ROOT.match(holder)
    if match is None:
        return False
    first, second = match[1], match[2]
    own = scope.self_name if scope.self_name is not None else "self"
    if first == own:
        bindings = [b for s in reading.unit.lineage for b in s.attributes.get(second, [])]
    else:
        bindings = scope.names.get(first or second, []) if scope.kind != CLASS else []
    return bool(bindings) and all(
        b.how == "value" and not b.path and _makes(reading, b.value, scope) for b in bindings
    )


def _makes(reading: Reading, value: Node, scope: Scope) -> bool:
    """Whether an expression makes a new message, with no other one in it."""
    if value.type == "none":
        return True
    if value.type != "call" or any(arguments_of(value)):
        return False
    match reading.values.ways(field(value, "function"), scope):
        case (External(name),):
            return interface_of(name) is not None
        case _:
            return False
