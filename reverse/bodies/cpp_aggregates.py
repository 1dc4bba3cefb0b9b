"""Locals that hold several values: structures of the files, pairs and tuples, part by part.

Scalar replacement of aggregates: each part is a local of its own in the model.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies import cpp_inline
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.scope import Inline, Record, Variable
from rebsync.reverse.bodies.types.cpp_conversions import type_in
from rebsync.reverse.bodies.types.cpp_types import Carried
from rebsync.reverse.bodies.types.cpp_widths import place_of, wide_of
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of
from rebsync.static.types import BYTE, INT, SHORT

_MAKES = frozenset({"std::make_pair", "std::make_tuple"})
_STANDARD = re.compile(r"std::(pair|tuple)<")
# In a type of a part: it is no copy.
_REFERS = re.compile(r"[&*]|reference_wrapper|_ptr\b|span\b|view\b|decltype|auto")
_PAIR = ("first", "second")


@dataclass(frozen=True, slots=True)
class AggregatePart:
    """One part: its name, its type if that is written, its value, and who reads that."""

    name: str
    type: Node | None
    value: Node
    reader: CppStatementReader


def parts(
    reader: CppStatementReader, type_: Node | None, value: Node | None
) -> list[AggregatePart] | None:
    """The parts of what is made there, in their order; None for anything else.

    `type_` is the type that is written, if it is not left to the compiler.
    """
    if value is None or not reader.scope.open:
        return None
    call = call_of(value)
    known = reader.scope.functions.get(call.name) if call is not None else None
    if call is not None and isinstance(known, Inline) and call.target is None:
        result = known.function.result
        if result is None or _fields(reader, result) is None:
            return None
        given = cpp_inline.only_value(reader, value, known, call.arguments)
        return parts(given[0], result, given[1]) if given is not None else None
    values: Sequence[Node] | None = None
    if value.type in ("initializer_list", "argument_list"):
        values = named(value)
    elif value.type == "compound_literal_expression":
        type_, values = type_ or part(value, "type"), named(part(value, "value"))
    elif call is not None and call.name in _MAKES:
        names = _PAIR if call.name.endswith("pair") else map(str, range(len(call.arguments)))
        made = zip(names, call.arguments, strict=False)
        return [AggregatePart(name, None, each, reader) for name, each in made]
    elif call is not None and _STANDARD.match(call.name):
        function = part(value, "function")
        type_, values = type_ or function, call.arguments
    fields = _fields(reader, type_) if type_ is not None else None
    if values is None or fields is None or len(values) != len(fields):
        return None
    pairs = zip(fields, values, strict=True)
    return [AggregatePart(name, of, each, reader) for (name, of), each in pairs]


def _fields(reader: CppStatementReader, type_: Node) -> list[tuple[str, Node]] | None:
    """The parts of a type, with their types."""
    text = "".join(text_of(type_).split()).removeprefix("const")
    if (found := _STANDARD.match(text)) is not None:
        types = next(iter(inside(type_, "template_argument_list")), None)
        given = named(types) if types is not None else []
        if any(_REFERS.search(text_of(each)) for each in given):
            return None  # a part is another name of what it is made of
        names = _PAIR if found[1] == "pair" else tuple(map(str, range(len(given))))
        return list(zip(names, given, strict=False)) if len(names) == len(given) else None
    form = reader.scope.form
    if form is None or not form.objects.is_aggregate(text):
        return None
    return [(f.name, f.type) for f in form.objects.fields_of(text)]


def declared(
    reader: CppStatementReader, node: Node, names: Sequence[str], made: Sequence[AggregatePart]
) -> Iterator[m.Statement]:
    """The locals that structured bindings are of parts that nothing else names."""
    found = []
    for name, each in zip(names, made, strict=True):
        local, statements = _read(reader, node, name, each)
        found.append((name, local))
        yield from statements
    for name, local in found:
        reader.meaning(name, local, own=True)


def whole(
    reader: CppStatementReader, node: Node, name: str, made: Sequence[AggregatePart], constant: bool
) -> Iterator[m.Statement]:
    """The local that has the parts."""
    fields: dict[str, Variable] = {}
    for each in made:
        local, statements = _read(reader, node, f"{name}_{each.name}", each)
        fields[each.name] = local
        yield from statements
    reader.meaning(name, Record(fields, constant=constant), own=True)


def _read(
    reader: CppStatementReader, node: Node, name: str, each: AggregatePart
) -> tuple[Variable, list[m.Statement]]:
    """A local with the value of a part, and the statements that give it that."""
    inner, local = each.reader, Variable("")
    before = len(inner.before) if inner is reader else 0
    if each.type is not None:
        kept: Carried | None = inner.scope.carried(each.type)
        if kept is None or kept.type == TEXT or kept.type.dimensions:
            raise reader.unread(node, "the model has no type for a part of this")
        local = place_of(reader.fresh(name), kept)
        value = inner.expressions.stored(each.value, local)
    else:
        value = inner.expressions.read(each.value)
        of = type_in(inner.scope, value) or type_in(reader.scope, value)
        if of is None or of.dimensions or of == TEXT:
            raise reader.unread(node, "the model has no type for a part of this")
        wide = wide_of(inner.expressions, each.value)
        local = Variable(reader.fresh(name), INT if of in (BYTE, SHORT) else of, wide=wide)
    if len(inner.before) > before and inner is not reader:
        needed, inner.before = inner.before, []
    else:
        needed = []
    return local, [*needed, reader.local(node, local, value)]
