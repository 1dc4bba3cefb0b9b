"""`std::swap` of two places: three assignments by a local."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.types.cpp_conversions import place_of
from rebsync.reverse.models.building import bare, is_calm, is_place
from rebsync.reverse.syntax.cpp_calls import call_of


def swap(reader: CppStatementReader, node: Node) -> Iterator[m.Statement] | None:
    """The statements that swap two places; None for other calls.

    Unread: the places are of two types, or which element is one depends on the other.
    """
    call = call_of(node)
    if call is None or call.target is not None or call.name != "std::swap":
        return None
    if "swap" in reader.scope.functions or len(call.arguments) != 2:
        return None
    one, other = (bare(reader.expressions.read(a)) for a in call.arguments)
    places = [place_of(reader.scope, p) for p in (one, other)]
    types = {(p.type, p.bits, p.wide) for p in places}
    plain = all(is_place(p) and is_calm(p) for p in (one, other))
    if not plain or len(types) != 1 or places[0].type is None or places[0].type.dimensions:
        raise reader.unread(node, "the model has nothing that swaps these")
    if {p.name for p in places} & {*_indices(one), *_indices(other)}:
        raise reader.unread(node, "which element is swapped depends on what is swapped")
    return _three(reader, node, (one, other), places[0])


def _indices(place: m.Expression) -> set[str]:
    """The variables that say which element of an array a place is."""
    match place:
        case m.Index(array, index):
            names = {n.name for n in m.walk(index) if isinstance(n, m.Name | m.Member)}
            return names | _indices(array)
        case _:
            return set()


def _three(
    reader: CppStatementReader,
    node: Node,
    places: tuple[m.Expression, m.Expression],
    kept: Variable,
) -> Iterator[m.Statement]:
    one, other = places
    local = Variable(reader.fresh("swapped"), kept.type, kept.bits, (), kept.wide)
    reader.meaning(f"swapped {node.start_byte}", local)
    span = reader.cpp.span(node)
    yield reader.local(node, local, one)
    yield m.ExpressionStatement(m.Assign("=", one, other), (), span)
    yield m.ExpressionStatement(m.Assign("=", other, m.Name(local.name)), (), span)
