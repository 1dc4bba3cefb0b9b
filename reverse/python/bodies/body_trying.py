"""`try` of Python: what is read exactly raises nothing; what leaves nothing in the model may.

Of a block that does nothing that the model has it is open whether it ends by an exception: one of
the handlers runs then, or none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.python.bodies import body_raising
from rebsync.reverse.python.bodies.body_effects import is_log
from rebsync.reverse.python.bodies.body_rounds import leaves_only_unknowns
from rebsync.reverse.syntax.py_tree import field, named, text_of

if TYPE_CHECKING:
    from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader

# What runs behind a `try` even if something in it leaves the function or a loop; or does not.
_BEHIND = frozenset({"finally_clause", "else_clause"})
_LEAVING = frozenset({"return_statement", "break_statement", "continue_statement"})
_RAISED = "what may raise an exception here is not in the model"
_OPEN = "the model does not know whether this raises an exception"


def try_(reader: BodyStatementReader, node: Node) -> Iterator[m.Statement]:
    """The statements of a `try`; `Unread` is raised where handlers may run in the midst of it."""
    findings, span = reader.reading.findings, reader.frame.span(node)
    body = field(node, "body")
    jumps = any(n.type in _LEAVING for n in inside(body))
    if not reader.frame.is_start and not jumps and leaves_only_unknowns(reader, named(body)):
        yield from _either(reader, node)
        return
    count = len(findings.all)
    nodes, last = named(body), _returning_last(node)
    found = reader.statements(nodes[:-1] if last is not None else nodes)
    clauses = {c.type for c in named(node)}
    if not reader.frame.is_start:
        unsure = any(_may_raise(reader, n) for n in inside(body))
        if unsure or len(findings.all) > count or body_raising.is_raised_in(reader, body):
            raise Unread(span, _RAISED)
    if clauses & _BEHIND and jumps and last is None:
        raise Unread(span, "what runs behind a jump out of this is not read")
    yield from found
    if not reader.frame.is_start:
        yield from _behind(reader, node, "else_clause")
        yield from _behind(reader, node, "finally_clause")
    if last is not None:
        yield from reader.statements([last])


def _returning_last(node: Node) -> Node | None:
    """The plain `return` that a block ends with, behind which only `finally` runs.

    None where something else in the block jumps, or more may run behind it.
    """
    nodes = named(field(node, "body"))
    last = nodes[-1] if nodes and nodes[-1].type == "return_statement" else None
    if last is None or named(last) or _has(node, "else_clause"):
        return None
    others = (n for each in nodes[:-1] for n in inside(each))
    return None if any(n.type in _LEAVING for n in others) else last


def _either(reader: BodyStatementReader, node: Node) -> Iterator[m.Statement]:
    """One of the handlers of a block that the model has nothing of, or what runs without them."""
    span = reader.frame.span(node)
    handlers = [c for c in named(node) if c.type.startswith("except")]
    if any(n.type in _LEAVING for n in inside(node)) and _has(node, "finally_clause"):
        raise Unread(span, "what runs behind a jump out of this is not read")
    before = set(reader.frame.assigned)
    otherwise: m.Statement = m.Block(tuple(_behind(reader, node, "else_clause")))
    for handler in reversed(handlers):
        reader.frame.assigned = set(before)
        then = reader.block(_block(handler))
        if then.statements or otherwise != m.Block(()):
            choice = m.Choice((m.BoolLiteral(True), m.BoolLiteral(False)), span)
            otherwise = m.If(choice, then, otherwise, (), span)
    reader.frame.assigned = before
    if otherwise != m.Block(()):
        source = reader.frame.py.source
        reader.reading.findings.approximated(source, span, _OPEN, "", reader.within)
        yield otherwise
    yield from _behind(reader, node, "finally_clause")


def _behind(reader: BodyStatementReader, node: Node, clause: str) -> Iterator[m.Statement]:
    for each in named(node):
        if each.type == clause:
            yield from reader.statements(named(_block(each)))


def _has(node: Node, clause: str) -> bool:
    return any(each.type == clause for each in named(node))


def _block(clause: Node) -> Node:
    blocks: Sequence[Node] = [n for n in named(clause) if n.type == "block"]
    return blocks[-1] if blocks else clause


def _may_raise(reader: BodyStatementReader, node: Node) -> bool:
    """Whether what stands in a `try` may raise the exception that it waits for."""
    match node.type:
        case "call":
            return not _is_sure(reader, node)
        case "binary_operator" | "augmented_assignment":
            return text_of(field(node, "operator")).startswith(("/", "%", "**", "<<", ">>"))
        case "subscript" | "raise_statement" | "assert_statement" | "await" | "yield":
            return True
        case "delete_statement" | "for_statement" | "import_statement":
            return True
        case "import_from_statement" | "with_statement":
            return True
        case _:
            return False


def _is_sure(reader: BodyStatementReader, call: Node) -> bool:
    name = reader.reading.external(field(call, "function"), reader.frame)
    made = reader.reading.message_type(call, reader.frame)
    own = reader.reading.function(field(call, "function"), reader.frame)
    holder, _, method = text_of(field(call, "function")).rpartition(".")
    publishes = bool(holder) and method in libraries.methods_of(Kind.PUBLISH)
    sleeps = libraries.kind_of(name) is Kind.SLEEP and libraries.is_of_client(name)
    return is_log(call) or bool(made) or own is not None or publishes or sleeps


def inside(node: Node) -> Iterator[Node]:
    """A node and all within it, but for what is defined there."""
    waiting = [node]
    while waiting:
        current = waiting.pop()
        yield current
        if current.type not in ("function_definition", "class_definition", "lambda"):
            waiting += current.named_children
