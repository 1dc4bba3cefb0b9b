"""Locals that hold when a send arrives and expires."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_mailbox
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.scope import Record, Variable
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.types import INT, converts, is_integer


def declared(reader: CppStatementReader, node: Node) -> Iterator[m.Statement]:
    """The times of such a local: they are known where it is made, and counted from each send."""
    (declarator,) = node.children_by_field_name("declarator")
    name, value = part(declarator, "declarator"), part(declarator, "value")
    times = cpp_mailbox.times(reader.expressions, value)
    fields: dict[str, Variable] = {}
    for kind, time in times.items():
        of = type_in(reader.scope, time)
        is_whole = of is not None and is_integer(of) and converts(of, INT, {})
        if not is_calm(time) or not is_whole:
            raise reader.unread(value, "this time is no whole number of the model")
        local = Variable(reader.fresh(f"{text_of(name)}_{kind}"), INT)
        fields[kind] = local
        reader.meaning(local.name, local, own=True)
        yield reader.local(declarator, local, time)
    reader.meaning(text_of(name), Record(fields, cpp_mailbox.MOMENT, constant=True), own=True)


def is_moment(node: Node) -> bool:
    """Whether a declaration is one as `const When soon = after(a).deadline(d);`."""
    is_constant = any(text_of(c) == "const" for c in named(node) if c.type == "type_qualifier")
    declarators = node.children_by_field_name("declarator")
    is_single = [d.type for d in declarators] == ["init_declarator"]
    is_kept = any(
        c.type == "storage_class_specifier" for c in named(node)
    )  # from the first time on
    is_of_type = text_of(part(node, "type")) == cpp_mailbox.MOMENT
    if not is_constant or not is_single or is_kept or not is_of_type:
        return False
    return part(declarators[0], "declarator").type == "identifier"
