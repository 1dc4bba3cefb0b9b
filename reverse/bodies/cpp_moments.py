"""Locals and parameters that hold when a send arrives and expires."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_mailbox
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.known_functions import MOMENT
from rebsync.reverse.bodies.scope import Meaning, Record, Variable
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.syntax.cpp_declarations import CppParameter
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.types import INT, converts, is_integer


def declared(reader: CppStatementReader, node: Node) -> Iterator[m.Statement]:
    """The times of such a local: they are known where it is made, and counted from each send."""
    (declarator,) = node.children_by_field_name("declarator")
    name, value = text_of(part(declarator, "declarator")), part(declarator, "value")
    yield from kept(reader, reader, name, declarator, reader.expressions, value, True)


def bound(
    reader: CppStatementReader,
    inside: CppStatementReader,
    parameter: CppParameter,
    node: Node,
    argument: Node | None,
) -> Iterator[m.Statement]:
    """The times that a parameter gets, or has where the call leaves it out."""
    at: CppExpressionReader = reader.expressions
    if argument is None:
        if parameter.default is None:
            raise reader.unread(node, "what is left out of this call is not known")
        at, argument = cpp_mailbox.elsewhere(at, parameter.default[0]), parameter.default[1]
    constant = any(text_of(c) == "const" for c in named(parameter.node))
    yield from kept(reader, inside, parameter.name, node, at, argument, constant)


def made(reader: CppStatementReader, value: Node) -> Meaning:
    """The times that a function gives."""
    reader.before += kept(reader, reader, "when", value, reader.expressions, value, True)
    return reader.scope.locals["when"]


def kept(
    reader: CppStatementReader,
    inside: CppStatementReader,
    name: str,
    node: Node,
    at: CppExpressionReader,
    value: Node,
    constant: bool,
) -> Iterator[m.Statement]:
    """The locals of `reader` for the times that `at` reads, which `inside` knows by a name."""
    times = cpp_mailbox.times(at, value)
    fields: dict[str, Variable] = {}
    for kind, time in times.items():
        of = type_in(at.scope, time)
        is_whole = of is not None and is_integer(of) and converts(of, INT, {})
        if not is_calm(time) or not is_whole:
            raise reader.unread(node, "this time is no whole number of the model")
        local = Variable(reader.fresh(f"{name}_{kind}", inlining=inside is not reader), INT)
        fields[kind] = local
        inside.meaning(local.name, local, own=True)
        yield reader.local(node, local, time)
    inside.meaning(name, Record(fields, MOMENT, constant), own=True)


def is_for_time(reader: CppStatementReader, parameter: CppParameter, argument: Node | None) -> bool:
    """Whether a parameter of a function takes the time of a send."""
    if text_of(parameter.type) == MOMENT:
        return not parameter.refers or any(text_of(c) == "const" for c in named(parameter.node))
    is_any = parameter.type.type == "placeholder_type_specifier"
    return is_any and argument is not None and cpp_mailbox.is_time(reader.scope, argument)


def is_moment(reader: CppStatementReader, node: Node) -> bool:
    """Whether a declaration is one as `const When soon = after(a).deadline(d);`, or `auto`."""
    is_constant = any(text_of(c) == "const" for c in named(node) if c.type == "type_qualifier")
    declarators = node.children_by_field_name("declarator")
    is_single = [d.type for d in declarators] == ["init_declarator"]
    is_kept = any(
        c.type == "storage_class_specifier" for c in named(node)
    )  # from the first time on
    if not is_constant or not is_single or is_kept:
        return False
    name, value = part(declarators[0], "declarator"), part(declarators[0], "value")
    is_any = text_of(part(node, "type")) == "auto" and cpp_mailbox.is_time(reader.scope, value)
    is_of_type = is_any or text_of(part(node, "type")) == MOMENT
    return is_of_type and name.type == "identifier"
