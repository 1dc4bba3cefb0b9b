"""Functions of the node that bodies call: what they do stands in the place of the call."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.bodies.returns import without_returns
from rebsync.reverse.findings import Unread
from rebsync.reverse.python.bodies.body_arguments import arguments
from rebsync.reverse.python.bodies.body_effects import HARMLESS_DECORATORS
from rebsync.reverse.python.bodies.body_node_loops import forever
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Frame, Message, Nobody, Own, Var
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.python.bodies.body_variables import give
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import FUNCTION, PyParameter, Scope, has_splat
from rebsync.reverse.syntax.py_tree import field, named, text_of

_DEEPEST = 12
# What a function does, and what it returns, with who reads that.
Returned: TypeAlias = "tuple[list[m.Statement], BodyStatementReader, Node]"
_INNER = frozenset({"function_definition", "lambda"})


def inlined(reader: BodyStatementReader, own: Scope, call: Node) -> Iterator[m.Statement]:
    """A call as a statement: the body of the function, with its parameters as locals."""
    first, inner = _entered(reader, own, call)
    found = inner.body(body_of(own))
    reader.is_over = reader.is_over or (inner.frame.is_start and inner.is_over)
    plain = without_returns(found)
    if plain is None:
        why = "what it calls ends in the middle of a loop, or by cases"
        raise Unread(reader.frame.span(call), why)
    yield from first
    yield from plain


def returned(reader: BodyStatementReader, call: Node) -> Returned | None:
    """What a function of the node does and returns at its end, and who reads what it returns.

    None for what is no call of a function that returns a value there and nowhere else.
    """
    own = reader.reading.function(field(call, "function"), reader.frame) if _is_call(call) else None
    nodes = body_of(own) if own is not None and own.kind == FUNCTION else []
    returns = [n for n in nodes_in(own.node) if n.type == "return_statement"] if own else []
    if own is None or not nodes or returns != nodes[-1:] or not named(nodes[-1]):
        return None
    first, inner = _entered(reader, own, call)
    return [*first, *inner.body(nodes[:-1])], inner, named(nodes[-1])[0]


_LITERALS = (m.IntLiteral, m.BoolLiteral, m.FloatLiteral, m.StringLiteral)


def _is_call(node: Node) -> bool:
    return node.type == "call"


def _entered(
    reader: BodyStatementReader, own: Scope, call: Node
) -> tuple[list[m.Statement], BodyStatementReader]:
    """What a call puts into the parameters of a function, and who reads its body."""
    span = reader.frame.span(call)
    if own.node.id in reader.running or len(reader.running) > _DEEPEST:
        raise Unread(span, "a function that leads to itself is not read")
    if not set(own.decorators) <= HARMLESS_DECORATORS or text_of(own.node).startswith("async"):
        raise Unread(span, "what decorates this function is not known")
    outer = reader.frame
    frame = Frame(own, is_start=outer.is_start, server=outer.server, outer=outer)
    frame.kept = kept_names(reader.reading, own) if frame.is_start else frozenset()
    inner = type(reader)(
        reader.reading, frame, reader.within, own.node, (*reader.running, own.node.id), reader.loops
    )
    if has_splat(call):
        raise Unread(span, "what stars unpack into the arguments is not read")
    first: list[m.Statement] = []
    for parameter, node, given in arguments(own, call):
        first += _bound(reader, inner, parameter, node, given)
    return first, inner


def kept_names(reading: Reading, own: Scope) -> frozenset[str]:
    """The names that are used both in a loop that keeps the node running, or a function inside, and
    outside of it."""
    kept = reading.unit.kept
    if own.node.id not in kept:
        kept[own.node.id] = _kept_names(own)
    return kept[own.node.id]


def _kept_names(own: Scope) -> frozenset[str]:
    inside: set[str] = set()
    outside: set[str] = set()
    waiting: list[tuple[Node, bool]] = [(own.node, False)]
    while waiting:
        node, is_in = waiting.pop()
        if node.type == "identifier":
            (inside if is_in else outside).add(text_of(node))
        is_in = is_in or forever(node) or (node.type in _INNER and node != own.node)
        waiting += [(child, is_in) for child in node.named_children]
    return frozenset(inside & outside & set(own.names))


def _bound(
    reader: BodyStatementReader,
    inner: BodyStatementReader,
    parameter: PyParameter,
    node: Node | None,
    given: bool,
) -> Iterator[m.Statement]:
    """What a parameter stands for in the body."""
    frame, name = inner.frame, parameter.name
    if node is None or not given:
        ways = reader.reading.values.ways(node, frame.scope) if node is not None else ()
        frame.bound[name] = reader.reading.constant(ways) or Nobody()
        return
    is_same = all(b.how == "parameter" for b in frame.scope.names.get(name, ()))
    if node.type in ("identifier", "attribute"):
        meaning, path = reader.expressions.meaning(node)
        if isinstance(meaning, (Own, Message)) and not path and is_same:
            frame.bound[name] = meaning
            return
    try:
        value = reader.expressions.read(node)
    except Unknown:
        frame.bound[name] = Nobody()
        return
    if is_same and isinstance(value.expression, _LITERALS):
        frame.bound[name] = value
        return
    variable = reader.reading.name(name, node, frame)
    if isinstance(variable, Var):
        yield from give(inner, variable, name, value, node)


# --- early ends ---------------------------------------------------------------------------------
