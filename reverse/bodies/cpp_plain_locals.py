"""Local variables as generated code declares them: of types of the model, by value."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_messages
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.shared import WORDS
from rebsync.reverse.bodies.types.cpp_types import SCALARS, type_of
from rebsync.reverse.syntax.cpp_tree import markers_in, named, part, text_of
from rebsync.source import Span

_MOST_LEFT_OUT = 1000  # elements of an array; each becomes a statement of its own


def late(reader: CppStatementReader, node: Node) -> m.Declaration | None:
    """The assignment that is the declaration of a local which C++ declares before a switch."""
    if not reader.hoisted or node.type != "assignment_expression":
        return None
    name, value = text_of(part(node, "left")), part(node, "right")
    type_ = reader.hoisted.get(name)
    if type_ is None:
        return None
    del reader.hoisted[name]
    initial: m.Initializer | None
    if value.type == "compound_literal_expression":
        initial = braces(reader, part(value, "value"), type_)
    else:
        initial = reader.expressions.read(value)
    declarator = m.Declarator(reader.scope.local(name), initial, reader.cpp.span(node))
    return m.Declaration(type_, (declarator,), span=reader.cpp.span(node))


def declared(reader: CppStatementReader, node: Node) -> m.Declaration:
    """The declaration; its names are locals from here on."""
    type_ = type_of(part(node, "type"))
    assert type_ is not None
    declarators = []
    for declarator in node.children_by_field_name("declarator"):
        declarators.append(_declarator(reader, declarator, type_))
    return m.Declaration(type_, tuple(declarators), span=reader.cpp.span(node))


def _declarator(reader: CppStatementReader, node: Node, type_: m.Type) -> m.Declarator:
    """One local, with its first value."""
    name, initial = node, None
    if node.type == "init_declarator":
        name = part(node, "declarator")
    reader.scope = reader.scope.declare(text_of(name))
    local = reader.scope.local(text_of(name))
    if local in WORDS and not reader.scope.open:
        raise reader.unread(node, f'"{local}" is a word of the model', "give it another name")
    if name is node:
        check_set(reader, node, text_of(name), type_)
    if node.type == "init_declarator":
        value = part(node, "value")
        if value.type == "initializer_list":
            initial = braces(reader, value, type_)
        else:
            initial = reader.expressions.read(value)
    if not reader.scope.open:
        known = Variable(local, type_)
        reader.scope = reader.scope.with_locals({text_of(name): known})
    return m.Declarator(local, initial, reader.cpp.span(node), reader.cpp.span(name))


def check_set(reader: CppStatementReader, node: Node, name: str, type_: m.Type) -> None:
    """Raises `Unread` for a local without a value that may be read before it gets one.

    One of a scalar type, or an array of these, has an indeterminate value ([dcl.init]).
    """
    form = reader.scope.form
    if type_.name in SCALARS and (form is None or form.may_be_unset(reader.cpp, node, name)):
        why = "this may be read before it has a value"
        raise reader.unread(node, why, "give it a value where it is declared")


def braces(reader: CppStatementReader, node: Node, type_: m.Type) -> m.Initializer | None:
    """`{}` is no initial value; arrays have a pair of braces around the elements, or two."""
    values = named(node)
    if not values:
        return None
    if not type_.dimensions:
        return reader.expressions.read(values[0])
    inner = m.Type(type_.name, type_.dimensions[1:])
    if len(values) == 1 and values[0].type == "initializer_list":
        values = named(values[0])
    read: list[m.Initializer] = []
    for value in values:
        element = braces(reader, value, inner) if value.type == "initializer_list" else None
        read.append(element if element is not None else _element(reader, value, inner))
    missing = type_.dimensions[0] - len(read)
    if reader.scope.open and missing > 0:
        if missing > _MOST_LEFT_OUT:
            raise reader.unread(node, f"{missing} elements are left out here: too many to write")
        zero = cpp_messages.zero_of(inner)
        if zero is None:
            raise reader.unread(node, "what is left out of this array is not written")
        read += [zero] * missing
    return m.ArrayInitializer(tuple(read), reader.cpp.span(node))


def _element(reader: CppStatementReader, value: Node, type_: m.Type) -> m.Expression:
    if type_.dimensions:
        return reader.expressions.read(value)
    return reader.expressions.stored(value, Variable("", type_))


def elements(
    array: m.Expression, initial: m.Initializer | None, span: Span
) -> Iterator[m.Statement]:
    """The elements of an array, each as it is in braces."""
    if isinstance(initial, m.ArrayInitializer):
        for index, value in enumerate(initial.values):
            yield from elements(m.Index(array, m.IntLiteral(index)), value, span)
    elif initial is not None:
        yield m.ExpressionStatement(m.Assign("=", array, initial, span), (), span)


def is_plain(node: Node) -> bool:
    """Whether a declaration is one that generated code has: of a type of the model, by value."""
    if type_of(part(node, "type")) is None:
        return False
    if any(c.type == "storage_class_specifier" for c in node.named_children):
        return False
    for declarator in node.children_by_field_name("declarator"):
        initial = declarator.type == "init_declarator"
        name = part(declarator, "declarator") if initial else declarator
        if name.type != "identifier":
            return False
        if initial and part(declarator, "value").type == "argument_list":
            return False
    return True


def declared_names(node: Node) -> Iterator[str]:
    """The names that a declaration declares."""
    for declarator in node.children_by_field_name("declarator"):
        inner = declarator.child_by_field_name("declarator")
        yield text_of(inner or declarator)


def is_hoisting(node: Node) -> bool:
    """Whether a block only holds locals of a switch, and the switch."""
    comments = (text_of(c) for c in node.named_children if c.type == "comment")
    return any(t.startswith("local ") for t in markers_in(comments))
