"""Loops of Python: over numbers, by conditions, and those that keep a node running."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.building import bare, binary
from rebsync.reverse.findings import Unread
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.python.body_effects import is_log
from rebsync.reverse.python.body_node_loops import EndlessLoop, forever
from rebsync.reverse.python.body_rounds import leaves_nothing
from rebsync.reverse.python.body_scope import WHOLE, Key, Value
from rebsync.reverse.python.py_index import arguments_of, last_name
from rebsync.reverse.python.py_tree import field, is_label, named, text_of
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.static.types import INT

if TYPE_CHECKING:
    from rebsync.reverse.python.body_statement_reader import BodyStatementReader

_RANGES = ("builtins.range", "builtins.xrange")
_APART = frozenset({"while_statement", "for_statement", "function_definition", "lambda"})


def while_(reader: BodyStatementReader, node: Node) -> Iterator[m.Statement]:
    """`while c:` as it is; of a node that starts, one that goes on for ever as a server."""
    span = reader.frame.span(node)
    if node.child_by_field_name("alternative") is not None:
        raise Unread(span, "a loop with an else branch is not read")
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
    yield m.While(condition, body, (), span)


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
        n in libraries.serving() and k in serves for n, k in zip(names, known, strict=True)
    )


def _may_end(node: Node) -> bool:
    """Whether something follows a loop that ends before the node does."""
    if not _follows(node):
        return False
    condition = "".join(text_of(field(node, "condition")).split())
    waiting = named(field(node, "body"))
    while waiting:
        inner = waiting.pop()
        if inner.type == "break_statement":
            return True
        if inner.type not in _APART:
            waiting += inner.named_children
    return libraries.only_running().fullmatch(condition) is None


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
        over = name in libraries.over() or (call is not None and is_log(call))
        if not over and behind.type not in ("comment", "pass_statement"):
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


def for_(reader: BodyStatementReader, node: Node) -> Iterator[m.Statement]:
    """`for i in range(...)` as a loop of the model that counts."""
    span = reader.frame.span(node)
    target, over = field(node, "left"), field(node, "right")
    name = (
        reader.reading.external(field(over, "function"), reader.frame)
        if over.type == "call"
        else ""
    )
    if node.child_by_field_name("alternative") is not None:
        raise Unread(span, "a loop with an else branch is not read")
    if name not in _RANGES and leaves_nothing(reader, node):
        return
    if name not in _RANGES or target.type != "identifier":
        raise Unread(span, "what this loop goes through is not in the model")
    variable = text_of(target)
    if not _only_here(reader, node, variable):
        raise Unread(span, f'"{variable}" is used outside of this loop, or changed in it')
    plain, _ = arguments_of(over)
    if not 1 <= len(plain) <= 3:
        raise Unread(span, "what this loop goes through is not in the model")
    values = [_whole(reader, argument) for argument in plain]
    low = values[0] if len(values) > 1 else m.IntLiteral(0)
    high = values[1] if len(values) > 1 else values[0]
    step = _step(reader, values[2] if len(values) > 2 else m.IntLiteral(1), node)
    if not isinstance(bare(high), m.IntLiteral):
        end = reader.reading.fresh(f"{variable}_end")
        yield m.Local(m.Declaration(INT, (m.Declarator(end, high),)), (), span)
        high = m.Name(end)
    yield _counted(reader, node, variable, low, high, step)


def _whole(reader: BodyStatementReader, node: Node) -> m.Expression:
    value = reader.expressions.read(node)
    if value.kind != WHOLE:
        raise Unread(reader.frame.span(node), "a loop over other than whole numbers is not read")
    return reader.expressions.need(value, node, "range")


def _step(reader: BodyStatementReader, step: m.Expression, node: Node) -> int:
    match step:
        case m.IntLiteral(value) if 0 < value < 1 << 16:
            return value
        case m.Unary("-", m.IntLiteral(value)) if 0 < value < 1 << 16:
            return -value
        case _:
            raise Unread(reader.frame.span(node), "the step of this loop is not known")


def _counted(
    reader: BodyStatementReader,
    node: Node,
    variable: str,
    low: m.Expression,
    high: m.Expression,
    step: int,
) -> m.Statement:
    """A loop of the model. Its last step may leave the `int` only where that is near its end."""
    frame, span = reader.frame, reader.frame.span(node)
    key: Key = "local", node.id, variable
    name = reader.reading.fresh(variable, key)
    reader.reading.learnt.join(key, WHOLE)
    reader.reading.wide.add(name)
    outer = frame.bound.get(variable)
    frame.bound[variable] = Value(m.Name(name), WHOLE)
    before = set(frame.assigned)
    body = reader.block(field(node, "body"))
    frame.assigned = before
    del frame.bound[variable]
    if outer is not None:
        frame.bound[variable] = outer
    by = m.IntLiteral(abs(step))
    counts: m.Expression = m.Assign("+=" if step > 0 else "-=", m.Name(name), by)
    if abs(step) == 1:
        counts = m.Postfix("++" if step > 0 else "--", m.Name(name))
    condition = binary("<" if step > 0 else ">", m.Name(name), high)
    declared = m.Declaration(INT, (m.Declarator(name, low),))
    return m.For(declared, condition, (counts,), body, (), span)


def _only_here(reader: BodyStatementReader, node: Node, variable: str) -> bool:
    """Whether a loop's variable is only read, and only in such loops over it."""
    scope = reader.frame.scope
    bindings = scope.names.get(variable, [])
    if variable in scope.outer or scope.kind not in ("function", "lambda"):
        return False
    if any(b.how != "loop" for b in bindings):
        return False
    loops = [b.node for b in bindings]
    inner = [n for n in loops if n != node and _holds(node, n)]
    if inner:
        return False
    waiting = [scope.node]
    while waiting:
        current = waiting.pop()
        if current in loops:
            continue
        if current.type == "identifier" and text_of(current) == variable and not is_label(current):
            return False
        waiting += current.named_children
    return True


def _holds(outer: Node, inner: Node) -> bool:
    return outer.start_byte <= inner.start_byte and inner.end_byte <= outer.end_byte
