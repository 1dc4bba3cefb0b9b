"""Messages as variables of the model, one for each field, and what publishers do with them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache, partial

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_mailbox, overloads
from rebsync.reverse.bodies.cpp_places import field_of, resolve
from rebsync.reverse.bodies.cpp_pointers import check_shared, is_null, pointed, points
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.cpp_unknowns import HINT, Demote, Unknown, choice, domain_near
from rebsync.reverse.bodies.effects.cpp_effects import Effects
from rebsync.reverse.bodies.effects.cpp_roots import path_in
from rebsync.reverse.bodies.overloads import plain, telling
from rebsync.reverse.bodies.scope import (
    Called,
    Inline,
    Publishes,
    Record,
    Scope,
    Target,
    Variable,
    of_width,
)
from rebsync.reverse.bodies.types.cpp_conversions import converted_to, type_in
from rebsync.reverse.bodies.types.cpp_types import wider
from rebsync.reverse.findings import Unread
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.models.texts import TEXT, any_text, text_literal
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.types import is_boolean

_POINTER = re.compile(r"(?:::)?(?:Const)?(?:Shared|Unique|Weak)?Ptr$")
_SHARED = re.compile(r"(?:::)?(?:boost|std)::(?:shared|unique)_ptr<(.*)>$")
# A field of something, with those of it; what gives the last of them a value.
_CHAIN = re.compile(r"(?:\.|->)\s*(\w+(?:\s*\.\s*\w+)*)")
_SET = re.compile(r"\s*=[^=]")
# The namespace of messages in ROS 2.
_SPACE = re.compile(r"::(?:msg|srv|action)::(?=\w+\Z)")
_MAKES = re.compile(r"(?:::)?(?:boost|std)::make_(?:shared|unique)<(.*)>$")


def message_type(scope: Scope, text: str) -> str | None:
    """The message type that a type of C++ is, or points to; None for other types."""
    package, name = _package_and_name(text)
    if package and package != "msg":
        full = f"{package}/{name}"
        return full if full in scope.messages else None
    same = [t for t in scope.messages if t.endswith(name) and t.rpartition("/")[2] == name]
    return same[0] if len(same) == 1 else None


@lru_cache(maxsize=512)  # the same few types are written again and again
def _package_and_name(text: str) -> tuple[str, str]:
    plain = "".join(re.sub(r"\bconst\b", " ", text).split()).rstrip("&*").removeprefix("::")
    shared = _SHARED.match(plain)
    plain = _POINTER.sub("", shared[1] if shared is not None else plain)
    package, _, name = _SPACE.sub("::", plain).rpartition("::")
    return package, name


def is_pointer(text: str) -> bool:
    """Whether a type of C++ points to a message."""
    plain = "".join(text.split())
    return bool(_POINTER.search(plain) or _SHARED.match(plain)) or plain.endswith("*")


def zero_of(type_: m.Type) -> m.Expression | None:
    """What a variable holds that was never set; None for an array."""
    if type_.dimensions:
        return None
    match type_.name:
        case "boolean":
            return m.BoolLiteral(False)
        case "float" | "double":
            return m.FloatLiteral("0.0")
        case TEXT.name:
            return text_literal("")
        case _:
            return m.IntLiteral(0)


# --- the fields of a message --------------------------------------------------------------------


def given(reader: CppStatementReader, node: Node) -> tuple[Record, bool]:
    """The message that an expression is, and whether it is a new one, all of it zero.

    Raises `Unknown` for one that the model cannot know.
    """
    match resolve(reader.scope, node):
        case Record() as record:
            return record, False
    match node.type:
        case "new_expression" | "compound_literal_expression":
            type_ = message_type(reader.scope, text_of(part(node, "type")))
            if type_ is not None and not _filled(node):
                return Record({}, type_), True
        case "parenthesized_expression" | "pointer_expression" if named(node):
            return given(reader, named(node)[0])
        case "call_expression":
            return _called(reader, node)
    raise Unknown(reader.cpp.span(node), f'the model cannot know "{text_of(node)}"')


def _filled(node: Node) -> bool:
    """Whether a message is made from arguments."""
    inner = node.child_by_field_name("arguments") or node.child_by_field_name("value")
    return inner is not None and bool(named(inner))


def _called(reader: CppStatementReader, node: Node) -> tuple[Record, bool]:
    function, arguments = part(node, "function"), named(part(node, "arguments"))
    text = text_of(function)
    makes = _MAKES.match(text)
    type_ = message_type(reader.scope, makes[1] if makes is not None else text)
    if type_ is not None and not arguments:
        return Record({}, type_), True
    if (type_ is not None or text in ("std::move",)) and len(arguments) == 1:
        return given(reader, arguments[0])
    name = text.removeprefix("this->").rpartition("::")[2]
    inline = reader.scope.functions.get(name)
    if isinstance(inline, Inline):
        result = reader.inlined(node, inline, arguments)
        if isinstance(result, Record):
            return result, False
    raise Unknown(reader.cpp.span(node), f'the model cannot know what "{text}" gives')


def needed(reader: CppStatementReader, type_: str) -> Mapping[str, m.Type]:
    """The fields of a message type that matter to the model in the body that is read."""
    sent: set[str] = set()
    for member in reader.scope.members.values():
        if isinstance(member, Publishes) and member.type in (type_, ""):
            sent |= {path for target in member.targets for path in target.fields}
    texts = [reader.text()]
    for function in reader.scope.functions.values():
        if isinstance(function, Called):
            sent |= {p for take in function.takes or () if isinstance(take, tuple) for p in take}
            texts += [text_of(f.node) for f in function.overloads]
        if isinstance(function, Inline):
            texts.append(text_of(function.function.node))
    whole = "\n".join(texts)
    return {
        path: of
        for path, of in reader.scope.messages.get(type_, {}).items()
        if of is not None and (path in sent or _is_read(path, whole, texts))
    }


def _is_read(path: str, whole: str, texts: Sequence[str]) -> bool:
    # Most are not even mentioned.
    mentioned = all(piece in whole for piece in path.split("."))
    return mentioned and any(path in _read_in(text) for text in texts)


@lru_cache(maxsize=256)  # the bodies of a class are asked for the same functions
def _read_in(text: str) -> frozenset[str]:
    """The paths of fields that a text reads: of `msg.pose.x` those are `pose`, `pose.x` and `x`."""
    found = set[str]()
    for chain in _CHAIN.finditer(text):
        pieces = [piece.strip() for piece in chain[1].split(".")]
        set_ = _SET.match(text, chain.end()) is not None
        last = len(pieces) - set_
        for end in range(1, last + 1):
            found.update(".".join(pieces[start:end]) for start in range(end))
    return frozenset(found)


def declare(
    reader: CppStatementReader,
    node: Node,
    name: str,
    type_: str,
    value: Node | None,
    pointer: bool,
    inlining: bool = False,
) -> Iterator[m.Statement]:
    """A local message: a local for each of its fields that matters."""
    source, fresh = given(reader, value) if value is not None else (Record({}, type_), True)
    if pointer and not fresh:
        reader.meaning(name, replace(source, pointer=True))
        return
    fields = {}
    for path, of in needed(reader, type_).items():
        held = source.fields.get(path)
        unless_new = m.Name(held.name) if held is not None else None
        initial = zero_of(of) if fresh else unless_new
        if _is_demoted(reader, f"{name}.{path}") or (not fresh and initial is None):
            continue
        width = reader.scope.width(type_, path)
        of_model = reader.fresh(f"{name}_{path.replace('.', '_')}", inlining)
        variable = of_width(of_model, of, width)
        if of_model in reader.scope.overflowing:
            place, why = reader.cpp.span(node), wider(path)
            reader.findings.assumed(reader.cpp.source, place, why, "", reader.within)
        reader.shared.made.add(variable.name)
        reader.shared.add(variable)
        fields[path] = variable
        span = reader.cpp.span(node)
        declarator = m.Declarator(variable.name, initial, span)
        yield m.Local(m.Declaration(of, (declarator,), span=span), (), span)
    reader.meaning(name, Record(fields, type_, pointer=pointer), own=True)


def _is_demoted(reader: CppStatementReader, field: str) -> bool:
    """Whether a field, or a part of the message that it is in, gets values that nobody knows."""
    return any(field == d or field.startswith(f"{d}.") for d in reader.shared.demoted)


def assign(reader: CppStatementReader, target: Node, value: Node) -> Iterator[m.Statement] | None:
    """`message = other`: each field; None where the target is no message."""
    record = resolve(reader.scope, target)
    if not isinstance(record, Record):
        return None
    return _copied(reader, target, record, value)


def _copied(
    reader: CppStatementReader, target: Node, record: Record, value: Node
) -> Iterator[m.Statement]:
    if record.pointer and target.type != "pointer_expression":
        raise Unread(reader.cpp.span(target), "a pointer to a message gets another message")
    span = reader.cpp.span(target)
    if record.there and is_null(value):
        yield points(record, m.BoolLiteral(False), span)
        return
    source, fresh = given(reader, value)
    if not fresh:
        check_shared(reader.cpp, record, target, value)
    if record.there and target.type != "pointer_expression":
        other = pointed(reader.scope, value)
        is_there = m.Name(other.there) if other is not None else m.BoolLiteral(True)
        yield points(record, is_there, span)
    for path, variable in record.fields.items():
        right: m.Expression | None = None
        if fresh and variable.type is not None:
            right = zero_of(variable.type)
        elif (held := source.fields.get(path)) is not None:
            right = m.Name(held.name)
        if right is None:
            right = _unknown_field(reader, target, value, path, variable)
        assigned = m.Assign("=", m.Name(variable.name), converted_to(reader.scope, right, variable))
        yield m.ExpressionStatement(assigned, (), span)


def _unknown_field(
    reader: CppStatementReader, target: Node, value: Node, path: str, variable: Variable
) -> m.Expression:
    """What a field gets from a message of which the model lacks it."""
    before = path_in(target)
    name = f"{text_of(target).partition('.')[0].partition('->')[0]}"
    whole = ".".join(piece for piece in (name, before, path) if piece)
    if name in reader.own and whole not in reader.shared.demoted:
        raise Demote({whole})
    why = f'the model cannot know "{text_of(value)}.{path}"'
    if variable.type == TEXT:
        reader.scope.changed_texts.add(variable.name)
    found = unknown_value(reader, value, variable.type, why)
    if found is None:
        reader.findings.open_members.add(whole.removeprefix("this."))
        raise Unknown(reader.cpp.span(value), why, HINT)
    return found


def unknown_value(
    reader: CppStatementReader, node: Node, type_: m.Type | None, why: str
) -> m.Expression | None:
    """A choice for a value that the model cannot know; None where too many are possible."""
    values = domain_near(node) if reader.cpp.has_markers else None
    if values is None and type_ is not None and is_boolean(type_):
        values = m.BoolLiteral(True), m.BoolLiteral(False)
    if type_ == TEXT:
        values = (any_text(),)
    if not values:
        return None
    reader.expressions.approximate(node, Unknown(reader.cpp.span(node), why))
    return choice(values)


# --- publishers ---------------------------------------------------------------------------------


def published(reader: CppStatementReader, node: Node) -> Iterator[m.Statement] | None:
    """`publisher.publish(message)`: a send to each receiver; None for another call."""
    function = part(node, "function")
    if function.type != "field_expression":
        return None
    if text_of(part(function, "field")) not in libraries.named(Kind.PUBLISH):
        return None
    arguments = named(part(node, "arguments"))
    target, times = part(function, "argument"), {}
    through = cpp_mailbox.is_runtime(reader.expressions, target) and len(arguments) == 3
    if through:
        times = cpp_mailbox.times(reader.expressions, arguments[2])
        target, arguments = arguments[0], arguments[1:2]
    publishes = resolve(reader.scope, target)
    if not isinstance(publishes, Publishes) or len(arguments) != 1:
        return None
    if publishes.timed and not through:
        why = "a message gets its times from the mailbox: without, its receiver drops it"
        raise reader.unread(node, why, "mailbox_.publish(publisher, message, When())")
    return _sends(reader, node, publishes, arguments[0], times)


def _sends(
    reader: CppStatementReader,
    node: Node,
    publishes: Publishes,
    argument: Node,
    times: Mapping[str, m.Expression],
) -> Iterator[m.Statement]:
    span = reader.cpp.span(node)
    record, fresh = Record({}, publishes.type), False
    if publishes.timed or any(target.fields for target in publishes.targets):
        try:
            record, fresh = given(reader, argument)
        except Unknown:
            Effects(reader.cpp, reader.scope).check(_moved(argument))
        if record.type and publishes.type and record.type != publishes.type:
            raise reader.unread(node, f'the publisher is for "{publishes.type}", not for this')
    else:
        Effects(reader.cpp, reader.scope).check(_moved(argument))
    for target in publishes.targets:
        values = _values(reader, argument, target, record, fresh, publishes.type)
        if target.rivals:
            values = _told(reader, node, target, values, publishes.type)
        to = m.Name(target.known) if target.known is not None else m.Self()
        after, deadline = times.get("after"), times.get("deadline")
        call = m.Call(to, target.server, values, after, deadline, span)
        yield m.ExpressionStatement(call, (), span)


def _told(
    reader: CppStatementReader,
    node: Node,
    target: Target,
    values: tuple[m.Expression, ...],
    message: str,
) -> tuple[m.Expression, ...]:
    """What is sent, by which the model chooses this server among overloads."""
    types = reader.scope.messages.get(message, {})
    own = plain([types.get(path) for path in target.fields])
    told = telling(values, own, target.rivals, partial(type_in, reader.scope))
    if told is None:
        raise reader.expressions.unread(node, overloads.WHY, overloads.HINT)
    return told


def _moved(argument: Node) -> Node:
    """What is handed over by `std::move`."""
    if argument.type == "call_expression" and text_of(part(argument, "function")) == "std::move":
        inner = named(part(argument, "arguments"))
        return inner[0] if len(inner) == 1 else argument
    return argument


def _values(
    reader: CppStatementReader, node: Node, target: Target, record: Record, fresh: bool, type_: str
) -> tuple[m.Expression, ...]:
    types = reader.scope.messages.get(type_ or record.type, {})
    found: list[m.Expression] = []
    for path in target.fields:
        of = types.get(path)
        zero = zero_of(of) if fresh and of is not None else None
        match record.fields.get(path) or field_of(record, path), zero:
            case Variable(name), _:
                _check_sent(reader, node, path, name)
                found.append(m.Name(name))
            case _, None:
                why = f'the model cannot know the field "{path}" of this message'
                value = unknown_value(reader, node, of, why)
                if value is None:
                    raise Unread(reader.cpp.span(node), why, HINT)
                found.append(value)
            case _, zero:
                found.append(zero)
    return tuple(found)


def _check_sent(reader: CppStatementReader, node: Node, path: str, name: str) -> None:
    """Lists a number that the receiver takes for another: an `int` does not hold it."""
    if name in reader.scope.overflowing:
        why = f'"{path}" may wrap, or be more than the model\'s int can be: others get it wrong'
        unread = Unread(reader.cpp.span(node), why)
        reader.findings.unreadable(reader.cpp.source, unread, reader.within)
