"""What may fail where generated C++ only logs: divisions of integers, and elements by `at`.

The model has the statement that fails where the code does, with nothing else of what is logged: so
what is logged under a condition, or of a number that is never zero, can be shown to do nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.intervals import exactly
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_kinds import SHORT_CIRCUIT
from rebsync.reverse.bodies.types.cpp_ranges import range_of
from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.cpp_tree import named, part, text_of


def may_fail(reader: CppStatementReader, node: Node) -> bool:
    """Whether there is something in a statement that may fail."""
    if node.type == "lambda_expression":
        return False
    if _is_division(reader, node) or _element(reader, node) is not None:
        return True
    return any(may_fail(reader, child) for child in named(node))


def failing(reader: CppStatementReader, node: Node) -> Iterator[m.Statement]:
    """What may fail in an expression, each under what must hold for it to be evaluated.

    Unread: the model has no expression for it.
    """
    if not may_fail(reader, node):
        return
    if node.type == "conditional_expression":
        condition = part(node, "condition")
        ways = part(node, "consequence"), part(node, "alternative")
        yield from _guarded(reader, condition, *ways)
        return
    operator = text_of(part(node, "operator")) if node.type == "binary_expression" else ""
    if operator in SHORT_CIRCUIT:
        is_and = operator in ("&&", "and")
        left, right = part(node, "left"), part(node, "right")
        yield from _guarded(reader, left, *((right, None) if is_and else (None, right)))
        return
    for child in named(node):
        yield from failing(reader, child)
    span = reader.cpp.span(node)
    if _is_division(reader, node):
        divisor = _plain(reader).read(part(node, "right"))
        is_one = isinstance(divisor, m.Name | m.Member | m.Index | m.Paren)
        quotient = m.Binary("/", m.IntLiteral(1), divisor if is_one else m.Paren(divisor))
        yield m.ExpressionStatement(quotient, span=span)
    elif (element := _element(reader, node)) is not None:
        yield m.ExpressionStatement(element, span=span)


def _plain(reader: CppStatementReader) -> CppExpressionReader:
    """Reads expressions alone, with no statements before them."""
    return replace(reader.expressions, findings=None, inlines=None)


def _guarded(
    reader: CppStatementReader, condition: Node, then: Node | None, otherwise: Node | None
) -> Iterator[m.Statement]:
    yield from failing(reader, condition)
    ways = [list(failing(reader, n)) if n is not None else [] for n in (then, otherwise)]
    if any(ways):
        read = _plain(reader).condition(condition)
        blocks = [m.Block(tuple(way)) for way in ways]
        other = blocks[1] if ways[1] else None
        yield m.If(read, blocks[0], other, span=reader.cpp.span(condition))


def _is_division(reader: CppStatementReader, node: Node) -> bool:
    """Whether an integer is divided by one that may be zero."""
    if node.type != "binary_expression" or text_of(part(node, "operator")) not in ("/", "%"):
        return False
    left, right = (range_of(reader.cpp, reader.scope, part(node, s)) for s in ("left", "right"))
    return left is not None and right is not None and right.values.includes(exactly(0))


def _element(reader: CppStatementReader, node: Node) -> m.Index | None:
    """The element of an array of the model, by an index that is checked."""
    if node.type != "call_expression" or len(named(part(node, "arguments"))) != 1:
        return None
    function = part(node, "function")
    if function.type != "field_expression" or text_of(part(function, "field")) != "at":
        return None
    try:
        read = _plain(reader).read(node)
    except Unread:
        return None
    return read if isinstance(read, m.Index) else None
