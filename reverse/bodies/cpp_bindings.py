"""Structured bindings: `auto& [x, y] = cell;` names the elements of an array, or the
members of a structure."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.touches import Touches
from rebsync.reverse.bodies.scope import Outside, Record, Variable
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

_BINDING = "structured_binding_declarator"


def names_in(declarator: Node) -> tuple[str, ...] | None:
    """The names that a declarator binds; None for one of a single variable."""
    target = part(declarator, "declarator") if declarator.type == "init_declarator" else declarator
    if target.type == "reference_declarator" and named(target):
        target = named(target)[-1]
    return tuple(text_of(n) for n in named(target)) if target.type == _BINDING else None


def bound(
    reader: CppStatementReader, node: Node, names: Sequence[str], value: Node | None, copies: bool
) -> Iterator[m.Statement]:
    """The locals that have the elements, or what the names of references stand for."""
    if value is None:
        raise reader.unread(node, "this binds nothing")
    record = resolve(reader.scope, value)
    if isinstance(record, Record) and not record.type and len(record.fields) == len(names):
        yield from _fields(
            reader, node, dict(zip(names, record.fields.values(), strict=True)), copies
        )
        return
    try:
        whole = reader.expressions.read(value)
    except Unread:
        if not copies and isinstance(resolve(reader.scope, value), Record):
            raise Touches(reader.cpp.span(value), "what these names are parts of") from None
        for name in names:
            reader.meaning(name, Outside())
        raise
    of = type_in(reader.scope, whole)
    is_place = isinstance(whole, m.Name | m.Member)
    if of is None or of.dimensions[:1] != (len(names),) or not is_place:
        why = "the model does not know the parts that these names are of"
        kind = Touches if reader.scope.open and not copies else Unread
        raise kind(reader.cpp.span(node), why)
    inner = m.Type(of.name, of.dimensions[1:])
    for index, name in enumerate(names):
        element = m.Index(whole, m.IntLiteral(index))
        if not copies:
            reader.meaning(name, element)
            continue
        local = Variable(reader.fresh(name), inner)
        reader.meaning(name, local, own=True)
        yield reader.local(node, local, element)


def _fields(
    reader: CppStatementReader, node: Node, fields: Mapping[str, Variable], copies: bool
) -> Iterator[m.Statement]:
    """The same for all the members of a plain structure, in their order."""
    for name, field in fields.items():
        if not copies:
            reader.meaning(name, field)
            continue
        local = replace(field, name=reader.fresh(name), domain=())
        reader.meaning(name, local, own=True)
        yield reader.local(node, local, m.Name(field.name))
