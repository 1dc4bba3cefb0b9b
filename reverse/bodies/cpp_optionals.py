"""`std::optional` of a number or truth value: a variable, and one that says whether it is there.

What `*x` gives of one that is empty nobody may look at: such code means nothing.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_messages, cpp_texts
from rebsync.reverse.bodies.cpp_places import HELD, resolve
from rebsync.reverse.bodies.cpp_pointers import is_null, points
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.scope import Record, Variable
from rebsync.reverse.bodies.types.cpp_conversions import converted_to, type_in
from rebsync.reverse.bodies.types.cpp_types import arguments_of
from rebsync.reverse.bodies.types.cpp_widths import check_stored, place_of
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_tree import named
from rebsync.static.types import BOOLEAN

_FALSE, _TRUE = m.BoolLiteral(False), m.BoolLiteral(True)


def assign(reader: CppStatementReader, target: Node, value: Node) -> Iterator[m.Statement] | None:
    """`x = e`, where `x` is an optional or a message; None for others."""
    optional = resolve(reader.scope, target)
    if not isinstance(optional, Record) or HELD not in optional.fields:
        return cpp_messages.assign(reader, target, value)
    there, read = _given(reader, value, optional.fields[HELD])
    return _stored(reader, value, optional, there, read)


def _stored(
    reader: CppStatementReader,
    node: Node,
    optional: Record,
    there: m.Expression,
    value: m.Expression | None,
) -> Iterator[m.Statement]:
    span = reader.cpp.span(node)
    if value is not None:
        held = m.Name(optional.fields[HELD].name)
        yield m.ExpressionStatement(m.Assign("=", held, value, span), (), span)
    yield points(optional, there, span)


def _given(
    reader: CppStatementReader, node: Node, held: Variable
) -> tuple[m.Expression, m.Expression | None]:
    """Whether an optional that gets this is there, and with what value."""
    call = call_of(node) if node.type == "call_expression" else None
    inner = named(node) if node.type == "initializer_list" else [node]
    if call is not None and call.name == "std::make_optional" and len(call.arguments) == 1:
        inner = [*call.arguments]
    if not inner or is_null(inner[0]):
        return _FALSE, None
    if len(inner) > 1:
        raise reader.unread(node, "an optional holds one value")
    match resolve(reader.scope, inner[0]):
        case Record(fields, there=there) if HELD in fields:
            value: m.Expression = m.Name(fields[HELD].name)
            return m.Name(there), converted_to(reader.scope, value, held)
    value = reader.expressions.read(inner[0])
    if type_in(reader.scope, value) is None:
        raise reader.unread(node, "whether this is a value is not known")
    cpp_texts.check_stored(reader.expressions, inner[0], value, held)
    check_stored(reader.expressions, inner[0], value, held)
    return _TRUE, converted_to(reader.scope, value, held)


def declare(
    reader: CppStatementReader, node: Node, name: str, type_: Node, value: Node | None
) -> Iterator[m.Statement] | None:
    """The locals of the model for `std::optional<int> x = e`; None for another type."""
    types = arguments_of(type_, "optional")
    kept = reader.scope.carried(types[0]) if len(types) == 1 else None
    if kept is None or kept.type.dimensions or kept.type == TEXT:
        return None
    there, read = (_FALSE, None) if value is None else _given(reader, value, place_of("", kept))
    held = place_of(reader.fresh(name), kept)
    read = read if read is not None else cpp_messages.zero_of(kept.type)
    flag = Variable(reader.fresh(f"{name}_is_there"), BOOLEAN)
    reader.meaning(name, Record({HELD: held}, there=flag.name), own=True)
    return iter((reader.local(node, held, read), reader.local(node, flag, there)))
