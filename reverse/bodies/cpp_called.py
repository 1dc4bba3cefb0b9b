"""Calls in expressions: of functions of the class, of the run-time part, of libraries."""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync import precedence
from rebsync.reverse.bodies import cpp_idioms, cpp_mailbox
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.cpp_places import element_of, is_this
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.bodies.scope import (
    Around,
    Called,
    Ignored,
    Inline,
    Itself,
    Lambda,
    Sends,
    is_another,
)
from rebsync.reverse.bodies.types.cpp_types import class_name
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

_OPERATIONS = {
    "divide": "/",
    "remainder": "%",
    "shiftLeft": "<<",
    "shiftRight": ">>",
}
_ASSIGNMENTS = {f"{name}By": f"{operator}=" for name, operator in _OPERATIONS.items()}
_MATHEMATICS = frozenset({"pow", "sqrt"})
_WIDTHS = frozenset({"narrow", "widen"})


def called(reader: CppExpressionReader, node: Node) -> m.Expression:
    """What the call of any function means."""
    function, arguments = part(node, "function"), named(part(node, "arguments"))
    match function.type:
        case "identifier":
            return by_name(reader, node, text_of(function), arguments, m.Self)
        case "template_function":
            return _template(reader, node, function, arguments)
        case "qualified_identifier":
            return _qualified(reader, node, function, arguments)
        case "field_expression":
            return _of_object(reader, node, function, arguments)
        case "primitive_type" if len(arguments) == 1:
            return reader.cast(function, arguments[0], node)
        case "lambda_expression" if not reader.scope.open and not arguments:
            return cpp_mailbox.in_order(reader, function)
        case "lambda_expression":
            return reader.inlined(node, Lambda(function, reader.scope), arguments)
        case _:
            raise reader.unknown(node, "the model cannot call this")


def by_name(
    reader: CppExpressionReader,
    node: Node,
    name: str,
    arguments: Sequence[Node],
    own: type[m.Self] | None,
) -> m.Expression:
    """A call of a function of the class; `own` is None where it is written as `this->f()`."""
    if isinstance(held := reader.scope.meaning(name), Lambda):
        return reader.inlined(node, held, arguments)
    match reader.scope.functions.get(name):
        case Sends() as sends:
            return cpp_mailbox.send(reader, node, sends, arguments, implicit=own is None)
        case Called(_, server=True) as several if reader.scope.open:
            meant = several.taking(len(arguments))
            if len(meant) == 1:
                return reader.inlined(node, Inline(meant[0]), arguments)
            raise reader.unread(node, f'what "{name}" does is not known here')
        case Called(_, server=True):
            why = f'"{name}" is a message server: a call runs it at once, a send does not'
            raise reader.unread(node, why, "send the message instead")
        case Called() as called:
            target = None if own is not None else m.Self(reader.cpp.span(node))
            return _local_method(reader, node, target, called, arguments)
        case Inline() as inline:
            return reader.inlined(node, inline, arguments)
        case Around():
            raise reader.unread(node, f'what "{name}" does the model does not describe')
        case Ignored():
            raise Unknown(reader.cpp.span(node), f'the model cannot know what "{name}" gives')
    if own is not None and name in _OPERATIONS and len(arguments) == 2:
        return reader.binary(node, _OPERATIONS[name], arguments)
    if own is not None and name in _ASSIGNMENTS and len(arguments) == 2:
        return reader.assign(node, _ASSIGNMENTS[name], arguments)
    return _other(reader, node, name, arguments, f'"{name}" is no function of this class')


def _other(
    reader: CppExpressionReader, node: Node, name: str, arguments: Sequence[Node], why: str
) -> m.Expression:
    """A function that the code does not have: one of a library."""
    if (element := element_of(reader.scope, name, arguments)) is not None:
        return m.Name(element.name, reader.cpp.span(node))
    read = cpp_idioms.call(reader, node, name.removeprefix("::"), arguments)
    if read is not None:
        return read
    if reader.scope.open:
        raise Unknown(reader.cpp.span(node), f'the model cannot know what "{name}" gives')
    raise reader.unread(node, why)


def _local_method(
    reader: CppExpressionReader,
    node: Node,
    target: m.Expression | None,
    called: Called,
    arguments: Sequence[Node],
) -> m.Expression:
    """The call of a local method."""
    if called.takes is None:
        return reader.calls(node, target, called.name, arguments)
    values = cpp_idioms.passed(reader, node, called, arguments)
    return m.Call(target, called.name, values, span=reader.cpp.span(node))


def _template(
    reader: CppExpressionReader, node: Node, function: Node, arguments: Sequence[Node]
) -> m.Expression:
    """A call with types: conversions, casts."""
    name, types = text_of(part(function, "name")), named(part(function, "arguments"))
    if len(types) == 1 and len(arguments) == 1:
        if name in _WIDTHS:  # what the model does unasked
            return reader.read(arguments[0])
        if name == "static_cast":
            return reader.cast(types[0], arguments[0], node)
        if name == "as":
            operand = reader.operand(arguments[0], precedence.CAST)
            return m.Cast(m.Type(class_name(text_of(types[0]))), operand, reader.cpp.span(node))
    if isinstance(known := reader.scope.functions.get(name), Inline):
        return reader.inlined(node, known, arguments)
    why = f'the model has no function "{name}"'
    return _other(reader, node, text_of(function), arguments, why)


def _qualified(
    reader: CppExpressionReader, node: Node, function: Node, arguments: Sequence[Node]
) -> m.Expression:
    """A call of a function of a class or of a library, by its full name."""
    owner, _, name = "".join(text_of(function).split()).rpartition("::")
    if owner == "std" and name in _MATHEMATICS:
        return reader.calls(node, None, name, arguments)
    called = reader.scope.functions.get(name)
    if owner in reader.scope.bases and isinstance(called, Called) and not called.server:
        return reader.calls(node, m.Super(reader.cpp.span(function)), called.name, arguments)
    if called is not None and owner not in ("std", "ros", "boost"):
        if reader.scope.open and is_another(called, f"{owner}::{name}"):
            why = f'the model has no "{owner}::{name}" beside its "{name}"'
            raise reader.unread(node, why, "give it a name of its own")
        return by_name(reader, node, name, arguments, m.Self)
    why = f'the model has no function "{owner}::{name}"'
    return _other(reader, node, text_of(function), arguments, why)


def _of_object(
    reader: CppExpressionReader, node: Node, function: Node, arguments: Sequence[Node]
) -> m.Expression:
    """A call of a function of some object."""
    target, name = part(function, "argument"), part(function, "field")
    if is_this(target):
        return by_name(reader, node, text_of(name), arguments, None)
    if isinstance(reader.scope.meaning(text_of(target)), Itself):
        return by_name(reader, node, text_of(name), arguments, m.Self)
    if cpp_mailbox.is_runtime(reader, target):
        return cpp_mailbox.built_in(reader, node, target, name, arguments)
    if text_of(name) == "at":
        return reader.index(function, arguments)
    read = cpp_idioms.member_call(reader, node, target, text_of(name), arguments)
    if read is not None:
        return read
    raise reader.unknown(node, f'the model cannot call "{text_of(function)}"')
