"""Loops of Python by conditions, and those that keep a node running."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.program_ends import over
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.models.rewriting import before_breaks
from rebsync.reverse.python.bodies import body_variables
from rebsync.reverse.python.bodies.body_effects import is_log
from rebsync.reverse.python.bodies.body_node_loops import EndlessLoop, forever
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import last_name
from rebsync.reverse.syntax.py_tree import field, named, text_of
from rebsync.static.types import BOOLEAN

_APART = frozenset({"while_statement", "for_statement", "function_definition", "lambda"})


def while_(reader: BodyStatementReader, node: Node) -> Iterator[m.Statement]:
    """`while c:` as it is; of a node that starts, one that goes on for ever as a server."""
    span = reader.frame.span(node)
    if reader.frame.is_start and node.child_by_field_name("alternative") is not None:
        raise Unread(span, "a loop of a node that starts with an else branch is not read")
    if reader.frame.is_start and _spins(reader, node):
        reader.is_over = True
        return
    if reader.frame.is_start and forever(node):
        if reader.frame.depth:
            raise Unread(span, "it depends on a condition whether this loop keeps the node running")
        if _may_end(node):
            raise Unread(span, "this loop may end while the node runs: what follows is not read")
        yield from _started(reader, node)
        return
    condition = reader.expressions.condition(field(node, "condition"))
    before = set(reader.frame.assigned)
    body = reader.block(field(node, "body"))
    reader.frame.assigned = before
    yield from with_else(reader, node, m.While(condition, body, (), span))


def with_else(
    reader: BodyStatementReader, node: Node, loop: m.While | m.For
) -> Iterator[m.Statement]:
    """A loop with its else branch, which runs unless a `break` ends the loop."""
    otherwise = node.child_by_field_name("alternative")
    if otherwise is None:
        yield loop
        return
    body, name = field(otherwise, "body"), reader.reading.fresh("completed")
    ended = m.ExpressionStatement(m.Assign("=", m.Name(name), m.BoolLiteral(False)))
    marked = before_breaks(loop.body, ended)
    if marked == loop.body:
        yield loop
        yield from reader.statements(named(body))
        return
    yield body_variables.declared(name, BOOLEAN, m.BoolLiteral(True))
    yield replace(loop, body=marked)
    before = set(reader.frame.assigned)
    yield m.If(m.Name(name), reader.block(body), None, (), reader.frame.span(otherwise))
    reader.frame.assigned = before


def _spins(reader: BodyStatementReader, node: Node) -> bool:
    """Whether a loop does nothing but to serve, as `spin` does: for as long as the node runs."""
    if (
        libraries.only_running().fullmatch("".join(text_of(field(node, "condition")).split()))
        is None
    ):
        return False
    called = [c for s in named(field(node, "body")) for c in named(s)]
    if not all(c.type == "call" for c in called):
        return False
    serving = [c for c in called if not is_log(c)]
    names = [last_name(field(c, "function")) for c in serving]
    known = [reader.reading.external(field(c, "function"), reader.frame) for c in serving]
    serves = {"", *libraries.names_of(Kind.SERVE)}
    return bool(names) and all(
        n in libraries.named(Kind.SERVE) and k in serves for n, k in zip(names, known, strict=True)
    )


def _may_end(node: Node) -> bool:
    """Whether something follows a loop that ends before the node does."""
    if not _follows(node):
        return False
    condition = "".join(text_of(field(node, "condition")).split())
    inside = (n for s in named(field(node, "body")) for n in nodes_in(s, *_APART))
    breaks = any(n.type == "break_statement" for n in inside)
    return breaks or libraries.only_running().fullmatch(condition) is None


def goes_on(node: Node) -> bool:
    """Whether more than the end of the program, or a log, follows a statement of its block."""
    at: Node | None = node
    while at is not None and not at.type.endswith("_statement"):
        at = at.parent
    behind = at.next_named_sibling if at is not None else None
    while behind is not None:
        inner = named(behind)
        call = inner[0] if inner and inner[0].type == "call" else None
        name = last_name(field(call, "function")) if call is not None else ""
        is_over = name in over() or (call is not None and is_log(call))
        if not is_over and behind.type not in ("comment", "pass_statement"):
            return True
        behind = behind.next_named_sibling
    return False


def _follows(node: Node) -> bool:
    """Whether anything but a log stands behind a statement in its function."""
    for at in (node, *ancestors(node, lambda n: n.type in ("function_definition", "module"))):
        behind = at.next_named_sibling
        while behind is not None:
            if behind.type not in ("comment", "pass_statement", "except_clause", "elif_clause"):
                return True
            behind = behind.next_named_sibling
    return False


def _started(reader: BodyStatementReader, node: Node) -> Iterator[m.Statement]:
    wish = reader.frame.scope.name
    name = reader.reading.server_name(node, wish if wish not in ("", "main") else "loop")
    reader.loops.append(EndlessLoop(name, node, reader.frame, reader.running, reader.only))
    reader.is_over = True
    yield m.ExpressionStatement(m.Call(m.Self(), name), (), reader.frame.span(node))
