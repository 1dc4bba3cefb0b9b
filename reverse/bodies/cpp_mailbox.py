"""Calls of the run-time part of generated code: the mailbox, the drive, sends with their times."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from tree_sitter import Node

from rebsync import model as m
from rebsync import precedence
from rebsync.names import original
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.cpp_places import is_this, resolve
from rebsync.reverse.bodies.effects.known_functions import MOMENT, TIMES
from rebsync.reverse.bodies.overloads import HINT, WHY, telling
from rebsync.reverse.bodies.scope import (
    Inline,
    Lambda,
    Record,
    Runtime,
    Scope,
    Sends,
    Variable,
)
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.libraries.tables.runtime import names_in_model
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.syntax.cpp_calls import string_of
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, squeezed, text_of
from rebsync.static.types import INT

_CLOCK = names_in_model(Language.CPP)
# The function under which a statement of `@Move` is read, until it is one.
MOVE = "@Move"
AT_ONCE = frozenset({"When()", "When{}", "{}"})
_LITERALS = frozenset({"number_literal", "char_literal", "true", "false"})
_HINT = "send it by a function that only sends"


def is_runtime(reader: CppExpressionReader, node: Node) -> bool:
    """Whether an expression names a member of the run-time part."""
    name = text_of(node)
    own = name.removeprefix("this->")
    hidden = name == own and name in reader.scope.locals
    return not hidden and isinstance(reader.scope.members.get(own), Runtime)


def has_mailbox(scope: Scope) -> bool:
    """Whether the class of a body serves its messages through the mailbox of generated code."""
    return any(isinstance(m, Runtime) and m.kind == "mailbox" for m in scope.members.values())


def built_in(
    reader: CppExpressionReader, node: Node, target: Node, name: Node, arguments: Sequence[Node]
) -> m.Expression:
    """A call of a function of the run-time part."""
    member = reader.scope.members[text_of(target).removeprefix("this->")]
    span = reader.cpp.span(node)
    function = text_of(part(name, "name") if name.type == "template_method" else name)
    if name.type == "template_method" and function == "delay":
        kept = [reader.scope.carried(each) for each in named(part(name, "arguments"))]
        if [k is not None and (k.type, k.bits, k.wide) == (INT, 0, 0) for k in kept] != [True]:
            raise reader.unread(node, "this is made another type before it is waited for")
    if isinstance(member, Runtime) and member.kind == "drive" and function == "move":
        return reader.calls(node, None, MOVE, arguments)
    if not isinstance(member, Runtime) or member.kind != "mailbox":
        raise reader.unread(node, f'the model cannot call "{text_of(target)}.{function}"')
    match function, len(arguments):
        case "self", 0:
            return m.Self(span)
        case "choose", 1 | 2:
            return m.Choice(tuple(reader.read(o) for o in named(arguments[0])), span)
        case "isA", 2:
            operand = reader.operand(arguments[0], precedence.BINARY["instanceof"])
            return m.InstanceOf(operand, m.Type(_class_named(reader, arguments[1])), span)
        case _, 0 if function in _CLOCK:
            return m.Name(_CLOCK[function], span)
        case "delay" | "assertion", _:
            return reader.calls(node, None, function, arguments)
        case "post", 4:
            return _posted(reader, node)
        case _:
            raise reader.unread(node, f'the model has no function "{function}"')


def _posted(reader: CppExpressionReader, node: Node) -> m.Expression:
    """`mailbox_.post(kX, after(1), text(a), [=] { x(a); })`, which a function that sends does."""
    posted = reader.scope.posts.get(node.id)
    if posted is None:
        why = "this is no server with its priority, the function that serves it, and its arguments"
        raise reader.unread(node, why, _HINT)
    sends, arguments = posted
    for argument in arguments[: sends.arguments]:
        if not _is_copied(reader.scope, argument):
            raise reader.unread(argument, "this is evaluated when the message is served", _HINT)
    return send(reader, node, sends, arguments, implicit=False)


def _is_copied(scope: Scope, argument: Node) -> bool:
    """Whether a lambda has a value of its own: a local that it captures, or a literal."""
    local = scope.locals.get(text_of(argument)) if argument.type == "identifier" else None
    return argument.type in _LITERALS or isinstance(local, Variable | m.Name)


def _class_named(reader: CppExpressionReader, node: Node) -> str:
    """The class whose name a literal holds."""
    name = string_of(node)
    if name is None:
        raise reader.unread(node, "this class is not known before the node runs")
    return original(name)


def in_order(reader: CppExpressionReader, function: Node) -> m.Expression:
    """`[&] { const auto first = a; return f(first); }()`: operands in the order of the model."""
    captured = named(part(function, "captures"))
    if any(c.type == "lambda_capture_initializer" for c in captured):
        raise reader.unread(function, "what this function holds is not in the model")
    at, values = reader, []
    *stores, result = named(part(function, "body"))
    for store in stores:
        declarator = part(store, "declarator") if store.type == "declaration" else store
        if declarator.type != "init_declarator" or result.type != "return_statement":
            raise reader.unread(function, "the model has no functions inside expressions")
        values.append(at.read(part(declarator, "value")))
        name = text_of(part(declarator, "declarator")).lstrip("& ")
        at = replace(at, scope=at.scope.with_operand(name, values[-1]))
    read = at.read(at.only(result))
    match values, read:
        case [target, read_first, value], m.Assign("=", written, m.Cast(_, computed)) if (
            target == read_first == written
        ):
            inner = computed.inner if isinstance(computed, m.Paren) else computed
            if isinstance(inner, m.Binary):
                return m.Assign(f"{inner.operator}=", target, value, read.span)
    return read


# --- sends --------------------------------------------------------------------------------------


def send(
    reader: CppExpressionReader, node: Node, sends: Sends, arguments: Sequence[Node], implicit: bool
) -> m.Expression:
    """The call of a function that sends."""
    expected = sends.arguments + (sends.known is None)
    if not expected <= len(arguments) <= expected + 1:
        raise reader.unread(node, f"this sends with {expected} arguments")
    target: m.Expression | None
    if sends.known is None:
        target = reader.operand(arguments[0], precedence.PRIMARY)
    elif sends.known == "self":
        target = None if implicit else m.Self(reader.cpp.span(node))
    elif reader.scope.hides(sends.known):
        why = f'a local of the name "{sends.known}" hides whom this is sent to'
        raise reader.unread(node, why, "give the local another name")
    else:
        target = m.Name(sends.known, reader.cpp.span(node))
    values = tuple(reader.read(a) for a in arguments[expected - sends.arguments : expected])
    if sends.order:
        if not all(map(is_calm, values)):
            raise reader.unread(node, "what this changes is sent in another order")
        values = tuple(values[place] for place in sends.order)
    told = telling(values, sends.types, sends.rivals, partial(type_in, reader.scope))
    if told is None:
        raise reader.unread(node, WHY, HINT)
    if len(arguments) > expected:
        last = times(reader, arguments[expected])
    elif sends.usual is not None:
        last = times(elsewhere(reader, sends.usual[0]), sends.usual[1])
    else:
        last = {}
    after, deadline = last.get("after"), last.get("deadline")
    return m.Call(target, sends.server, told, after, deadline, reader.cpp.span(node))


def times(reader: CppExpressionReader, node: Node) -> dict[str, m.Expression]:
    """`after(a).deadline(d)`, by any name or out of any function; `When()` is neither."""
    if isinstance(held := resolve(reader.scope, node), Record) and held.type == MOMENT:
        return {kind: m.Name(time.name) for kind, time in held.fields.items()}
    if squeezed(node) in AT_ONCE:
        return {}
    spelled = text_of(node)
    constant = reader.scope.constants.get(spelled)
    if constant is not None and reader.scope.meaning(spelled) is None:
        scope = reader.scope.without_constant(spelled)
        return times(elsewhere(replace(reader, scope=scope), constant[0]), constant[1])
    if node.type != "call_expression":
        raise reader.unread(node, "this is no time of a send")
    function, arguments = part(node, "function"), named(part(node, "arguments"))
    found: dict[str, m.Expression] = {}
    name = function
    if function.type == "field_expression" and not is_this(part(function, "argument")):
        found = times(reader, part(function, "argument"))
        name = part(function, "field")
    elif (given := _given(reader, node, arguments)) is not None:
        return given
    if text_of(name) not in TIMES or len(arguments) != 1:
        raise reader.unread(node, "this is no time of a send")
    if name == function and not _is_of_runtime(reader.scope, text_of(name)):
        raise reader.unread(node, f'"{text_of(name)}" is another function here')
    return found | {text_of(name): reader.read(arguments[0])}


def _given(
    reader: CppExpressionReader, node: Node, arguments: Sequence[Node]
) -> dict[str, m.Expression] | None:
    """The time that a function of people gives; None for a call of no such function."""
    name = text_of(part(node, "function")).removeprefix("this->")
    function = reader.scope.meaning(name) or reader.scope.functions.get(name)
    if reader.inlines is None or not isinstance(function, Inline | Lambda):
        return None
    held = reader.inlines(node, function, arguments)
    if not isinstance(held, Record) or held.type != MOMENT:
        raise reader.unread(node, "this is no time of a send")
    return {kind: m.Name(time.name) for kind, time in held.fields.items()}


def is_time(scope: Scope, node: Node) -> bool:
    """Whether an expression is a time of a send: by its name, or made where it stands."""
    if isinstance(held := resolve(scope, node), Record):
        return held.type == MOMENT
    while node.type == "call_expression" and part(node, "function").type == "field_expression":
        node = part(part(node, "function"), "argument")
    if node.type == "compound_literal_expression":
        return text_of(part(node, "type")) == MOMENT
    name = text_of(part(node, "function")) if node.type == "call_expression" else ""
    return name in (MOMENT, *TIMES) and _is_of_runtime(scope, name)


def elsewhere(reader: CppExpressionReader, cpp: Cpp) -> CppExpressionReader:
    """A reader for what stands outside of the body: it names no locals, and calls nothing."""
    scope = replace(reader.scope, locals={})
    return replace(reader, cpp=cpp, scope=scope, findings=None, inlines=None)


def _is_of_runtime(scope: Scope, name: str) -> bool:
    """Whether nothing nearer has the name of a function of the run-time part."""
    return scope.meaning(name) is None and name not in scope.functions
