"""Messages that bodies make, fill and publish: their fields as arguments of sends."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping
from contextlib import contextmanager

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.build.message_types import Fields
from rebsync.reverse.findings import Unread
from rebsync.reverse.graph import PublisherFact
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.models.building import cast, is_calm
from rebsync.reverse.models.texts import TEXT, any_text
from rebsync.reverse.python.bodies import body_containers, body_methods
from rebsync.reverse.python.bodies.body_effects import is_harmless
from rebsync.reverse.python.bodies.body_expression_reader import BodyExpressionReader
from rebsync.reverse.python.bodies.body_reading import Reading, field_key, zero
from rebsync.reverse.python.bodies.body_scope import (
    Message,
    Pending,
    PyTarget,
    Var,
    bounds,
    field_kind,
    unknown,
)
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_variables import store
from rebsync.reverse.python.expressions.values import (
    OTHER,
    REAL,
    STRING,
    TRUTH,
    TYPES,
    WHOLE,
    Value,
)
from rebsync.reverse.syntax.py_index import arguments_of
from rebsync.reverse.syntax.py_tree import field, named, text_of
from rebsync.source import NOWHERE

_BEYOND = "a number that the field of the message may not hold, which Python refuses"
PROBE = "probe"  # of statements that are only looked at: they are not in the model
# The fields of a message that an expression makes: nodes, with what is read there.
Given = Mapping[str, Node]


def field_of(
    reader: BodyExpressionReader,
    node: Node | None,
    type_: str,
    path: str,
    given: Given | None = None,
) -> Value:
    """What a field holds of the message that an expression gives; None: of a new one."""
    fields = reader.reading.types.fields(type_) or {}
    kind = fields.get(path)
    if kind is None:
        span = reader.frame.span(node) if node is not None else NOWHERE
        raise Unread(span, f"the type of the field {path} is not known")
    if node is None:
        return zero(field_kind(kind))
    if reader.reading.message_type(node, reader.frame) is None and given is None:
        return _of_place(reader, node, path)
    parts = arguments_by_name(reader, node, fields) if given is None else given
    return _inside(reader, parts, kind, path, "")


def _inside(
    reader: BodyExpressionReader, parts: Given, kind: m.Type, path: str, above: str
) -> Value:
    """A field by what a call is given: itself, or a message that it is in."""
    rest = path.removeprefix(above)
    first = rest.partition(".")[0]
    at = parts.get(first)
    if at is None:
        return zero(field_kind(kind))
    if first == rest:
        return reader.read(at)
    inner = reader.reading.message_type(at, reader.frame)
    if inner is None:
        return _of_place(reader, at, rest.removeprefix(f"{first}."))
    return field_of(reader, at, inner, rest.removeprefix(f"{first}."))


def _of_place(reader: BodyExpressionReader, node: Node, path: str) -> Value:
    meaning, before = reader.meaning(node)
    if not isinstance(meaning, Message):
        raise unknown(reader.frame, node, f'"{text_of(node)}"')
    whole = f"{before}.{path}" if before else path
    return reader.reading.read_field(meaning, whole, node, reader.frame)


def arguments_by_name(reader: BodyExpressionReader, call: Node, fields: Fields) -> dict[str, Node]:
    """What a call that makes a message gives to its fields, by their names."""
    plain, keywords = arguments_of(call)
    names = list(dict.fromkeys(path.partition(".")[0] for path in fields))
    unpacked = any(
        a.type in ("list_splat", "dictionary_splat") for a in named(field(call, "arguments"))
    )
    if unpacked or (plain and len(plain) > len(names) and names):
        raise Unread(reader.frame.span(call), "it is not known which fields these are")
    return dict(zip(names, plain, strict=False)) | keywords


# --- publishing ---------------------------------------------------------------------------------


def published(reader: BodyStatementReader, call: Node) -> Iterator[m.Statement] | None:
    """`pub.publish(...)` as sends to all that receive it; None for what is no such call."""
    function = field(call, "function")
    if function.type != "attribute":
        return None
    if text_of(field(function, "attribute")) not in libraries.methods_of(Kind.PUBLISH):
        return None
    holder = field(function, "object")
    by_key = holder.type == "subscript"
    asked = body_containers.element if by_key else Reading.made_by
    found = asked(reader.reading, holder, reader.frame)
    number, fact = found if found is not None else (0, None)
    if not isinstance(fact, PublisherFact):
        raise Unread(reader.frame.span(call), "it is not known what this publishes to")
    if by_key:  # by a key that the container has
        place = reader.frame.py.source.path, reader.frame.span(holder)
        reader.reading.exact.add(place)
    return _sends(reader, call, fact, reader.reading.targets.get(number, ()))


def _sends(
    reader: BodyStatementReader, call: Node, fact: PublisherFact, targets: tuple[PyTarget, ...]
) -> Iterator[m.Statement]:
    plain, keywords = arguments_of(call)
    span = reader.frame.span(call)
    type_ = fact.type if isinstance(fact.type, str) else ""
    given: dict[str, Node] | None = None
    message = plain[0] if len(plain) == 1 and not keywords else None
    back = body_methods.returned(reader, message) if message is not None else None
    if back is not None and _is_message(back[1], back[2], type_):
        first, reader, message = back
        yield from first
        plain = [message]
    if message is None or not _is_message(reader, message, type_):
        given = arguments_by_name(
            reader.expressions, call, reader.reading.types.fields(type_) or {}
        )
        message = call
    for node in (*plain, *keywords.values()):
        is_name = node.type in ("identifier", "attribute")
        if not targets and not is_name and not is_harmless(reader.reading, node, reader.frame):
            raise Unread(span, "what is published here does more than to give a value")
    yield from _checked(reader, message, type_, given)
    read: dict[str, m.Expression] = {}
    for target in targets:
        arguments = []
        for path in target.target.fields:
            if path not in read:
                read[path] = yield from _argument(reader, message, type_, path, target, given)
            arguments.append(read[path])
        to: m.Expression = m.Self() if target.target.known is None else m.Name(target.target.known)
        sent = m.Call(to, target.target.server, tuple(arguments), span=span)
        yield m.ExpressionStatement(sent, (), span)


def _checked(
    reader: BodyStatementReader, message: Node, type_: str, given: Given | None
) -> Iterator[m.Statement]:
    """Fields that nobody gets must hold what they are given as well: statements to look at."""
    if given is None and reader.reading.message_type(message, reader.frame) is None:
        return
    fields = reader.reading.types.fields(type_) or {}
    parts = arguments_by_name(reader.expressions, message, fields) if given is None else given
    for path, kind in fields.items():
        if kind is None or kind.dimensions or kind == TEXT or path not in parts:
            continue
        try:
            value = field_of(reader.expressions, message, type_, path, given)
            found = as_field(reader.expressions, value, type_, path, message)
        except Unknown:
            continue
        yield m.ExpressionStatement(found, (m.Annotation(PROBE),))


def _is_message(reader: BodyStatementReader, node: Node, type_: str) -> bool:
    """Whether a message is published, not the value of its only field."""
    made = reader.reading.message_type(node, reader.frame)
    if made is not None:
        return True
    meaning, path = reader.expressions.meaning(node)
    if isinstance(meaning, Message):
        inner = (reader.reading.types.fields(meaning.type) or {}).get(path) if path else None
        return inner is None
    try:
        reader.expressions.read(node)
    except Unknown:
        fields = reader.reading.types.fields(type_) or {}
        return not all(t is None or t == TEXT for t in fields.values())
    return False


def _argument(
    reader: BodyStatementReader,
    message: Node,
    type_: str,
    path: str,
    target: PyTarget,
    given: Given | None,
) -> Generator[m.Statement, None, m.Expression]:
    """The value that is sent for a field; that nobody knows one is for the receiver to know."""
    kind = (reader.reading.types.fields(type_) or {}).get(path)
    try:
        with unless_text(reader.expressions, kind, message):
            value = field_of(reader.expressions, message, type_, path, given)
            found = as_field(reader.expressions, value, type_, path, message)
    except Unknown as open_:
        is_plain = is_harmless(reader.reading, message, reader.frame)
        if kind != TEXT or not is_plain or reader.frame.is_start:
            reader.reading.learnt.leave_open(target.unit, target.target.server, path)
            raise Unread(open_.span, open_.why) from open_
        reader.expressions.note(message, open_.why)
        found = any_text()
    is_chosen = not is_calm(found) or found == any_text()
    if is_chosen and len(reader.reading.targets) > 1:
        name = reader.reading.fresh(f"{path.rpartition('.')[2]}_sent")
        assert kind is not None
        yield m.Local(m.Declaration(m.Type(kind.name), (m.Declarator(name, found),)))
        return m.Name(name)
    return found


def as_field(
    reader: BodyExpressionReader, value: Value, type_: str, path: str, node: Node
) -> m.Expression:
    """A value as it is put into a field of a message, which takes no other kind."""
    fields = reader.reading.types.fields(type_) or {}
    kind = fields.get(path)
    assert kind is not None
    wanted, span = field_kind(kind), reader.frame.span(node)
    if value.kind != wanted:
        if value.kind in (TRUTH, STRING) or wanted in (TRUTH, WHOLE, STRING):
            raise Unread(span, f'"{path}" of {type_} holds no such value')
        library = reader.reading.unit.library
        if library.strict and value.kind == WHOLE:
            raise Unread(span, f'{library.name} takes no whole number for "{path}" of {type_}')
    if wanted == WHOLE:
        within = bounds(fields, reader.reading.types.widths.get(type_, {}), path)
        found = reader.need(value, node, f"field {path}", within, strict=_BEYOND)
        return cast(m.Type(kind.name), found) if kind.name != "int" else found
    if wanted == REAL:
        if kind.name == "float" and not (value.single and not _is_now(value)):
            return cast(m.Type("float"), reader.real(value, node))
        return (
            value.expression if value.single and kind.name == "float" else reader.real(value, node)
        )
    return value.expression


@contextmanager
def unless_text(
    reader: BodyExpressionReader, type_: m.Type | None, node: Node
) -> Generator[None, None, None]:
    """Reading a field: of a text that is not read nobody knows the value, if it does nothing."""
    try:
        yield
    except Unread as unread:
        is_over = isinstance(unread, Unknown | Pending)
        if is_over or type_ != TEXT or not is_harmless(reader.reading, node, reader.frame):
            raise
        raise Unknown(unread.span, unread.why, unread.hint) from unread


def _is_now(value: Value) -> bool:
    return isinstance(value.expression, m.Name) and value.expression.name == "now"


# --- messages in variables ----------------------------------------------------------------------


def made(reader: BodyStatementReader, message: Message, node: Node | None) -> Iterator[m.Statement]:
    """A new message in a variable: the fields that something sets or reads get their values."""
    fields = reader.reading.types.fields(message.type) or {}
    given = arguments_by_name(reader.expressions, node, fields) if node is not None else {}
    if not all(is_harmless(reader.reading, n, reader.frame) for n in given.values()):
        raise Unread(reader.frame.span(node or reader.root), "what is put into it does more")
    for path, type_ in fields.items():
        if type_ is None or type_.dimensions:
            continue
        key, is_given = field_key(message, path), path.partition(".")[0] in given
        if not is_given and reader.reading.learnt.kind(key) is None:
            continue
        if is_given and reader.reading.learnt.kind(key) != OTHER:
            try:
                with unless_text(reader.expressions, type_, node or reader.root):
                    value = field_of(reader.expressions, node, message.type, path)
                    as_field(reader.expressions, value, message.type, path, node or reader.root)
            except Unknown:
                reader.reading.learnt.join(key, OTHER)
                continue
        else:
            value = zero(field_kind(type_))
        yield from set_field(reader, message, path, value, node or reader.root)


def set_field(
    reader: BodyStatementReader, message: Message, path: str, value: Value, node: Node
) -> Iterator[m.Statement]:
    """A field of a message in a variable gets a value."""
    key = field_key(message, path)
    type_ = (reader.reading.types.fields(message.type) or {})[path]
    assert type_ is not None
    kind = field_kind(type_)
    reader.reading.learnt.join(key, kind)
    if reader.reading.learnt.kind(key) == OTHER:
        return
    name = reader.reading.field_name(message, path, node, reader.frame)
    stored = reader.expressions.real(value, node) if kind == REAL else value.expression
    if kind == WHOLE:
        reader.expressions.need(value, node, f"set {path}")
        reader.reading.wide.add(name)
    local = f"{message.key[2]}.{path}"
    variable = Var(message.key, name, message.is_state)
    yield from store(reader, variable, TYPES[kind], stored, local, node)
