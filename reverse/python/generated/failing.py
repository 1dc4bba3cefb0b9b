"""What may fail where something is only told to people: divisions, and elements of arrays.

The model has the statement that fails where the code does, with nothing else of what is told: so
what is told under a condition, or of a number that is never zero, can be shown to do nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.python.generated import idioms
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.slicing.exceptions import ToldExceptions
from rebsync.reverse.python.generated.slicing.logs import only_logs, own_method
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_tree import field, named, number_of, text_of

_DIVIDING = frozenset({"/", "//", "%"})
_DIVIDING_BY_NAME = frozenset({"divide", "remainder"})
_TEXTS = frozenset({"string", "concatenated_string"})
_LATER = frozenset({"generator_expression", "lambda", "list_comprehension", "set_comprehension"})


def told_people(expressions: ModelExpressionReader, node: Node) -> list[m.Statement] | None:
    """What may fail of a statement that only tells people something; None for any other.

    An `if` of which something may fail is read as others are. Unread: the model has not all of it.
    """
    silent = expressions.names.silent
    if not (silent.tells(node) or _logs_methods(expressions, node)):
        return None
    raised = next(unmodelled(expressions, node, silent.exceptions), None)
    if raised is None and not may_fail(expressions, node):
        return []
    if node.type == "if_statement":
        return None
    if raised is not None:
        raise expressions.unread(node, raised)
    return list(failing(expressions, node))


def _logs_methods(expressions: ModelExpressionReader, node: Node) -> bool:
    """Whether a statement logs, and calls methods of the model for what it logs."""
    looks = replace(expressions.names.silent.looks, own=methods_of(expressions))
    return node.type == "expression_statement" and only_logs(node, looks)


def may_fail(expressions: ModelExpressionReader, node: Node) -> bool:
    """Whether there is something in a statement that may fail, or is a method of the model."""
    if _divisor(node) or _is_element(expressions, node) or _is_method(expressions, node):
        return True
    return any(may_fail(expressions, child) for child in node.named_children)


def failing(expressions: ModelExpressionReader, node: Node) -> Iterator[m.Statement]:
    """What may fail in an expression, and calls of methods, in the order of evaluation.

    Unread: the model has no expression for it.
    """
    if not may_fail(expressions, node):
        return
    if node.type in _LATER:
        raise expressions.unread(node, "this may fail where it is told")
    if node.type == "conditional_expression":
        then, condition, otherwise = named(node)
        yield from _guarded(expressions, condition, then, otherwise)
        return
    if node.type == "boolean_operator":
        is_and = text_of(field(node, "operator")) == "and"
        left, right = field(node, "left"), field(node, "right")
        yield from _guarded(expressions, left, *((right, None) if is_and else (None, right)))
        return
    if _is_method(expressions, node):
        yield m.ExpressionStatement(expressions.expression(node), span=expressions.py.span(node))
        return
    for child in node.named_children:
        yield from failing(expressions, child)
    if (by := _divisor(node)) is not None:
        yield _divided(expressions, by)
    elif _is_element(expressions, node):
        yield m.ExpressionStatement(expressions.expression(node), span=expressions.py.span(node))


def unmodelled(
    expressions: ModelExpressionReader, node: Node, exceptions: ToldExceptions
) -> Iterator[str]:
    """Why what is told may raise an exception, but for what the model has of it (`failing`)."""
    modelled = [
        expressions.py.span(n) for n in nodes_in(node) if _divisor(n) or _is_element(expressions, n)
    ]
    return exceptions.reasons(node, modelled, methods_of(expressions))


def methods_of(expressions: ModelExpressionReader) -> frozenset[str]:
    """The methods of the model, by their names in Python."""
    names = expressions.names
    return frozenset(names.functions) - names.servers - names.sends.keys() - names.properties


def _is_method(expressions: ModelExpressionReader, node: Node) -> bool:
    return own_method(node) in methods_of(expressions)


def _guarded(
    expressions: ModelExpressionReader, condition: Node, then: Node | None, otherwise: Node | None
) -> Iterator[m.Statement]:
    yield from failing(expressions, condition)
    ways = [list(failing(expressions, n)) if n is not None else [] for n in (then, otherwise)]
    if any(ways):
        read = expressions.condition(condition)
        blocks = [m.Block(tuple(way)) for way in ways]
        span = expressions.py.span(condition)
        yield m.If(read, blocks[0], blocks[1] if ways[1] else None, span=span)


def _divided(expressions: ModelExpressionReader, divisor: Node) -> m.Statement:
    """A division by what the code divides by."""
    read, span = expressions.expression(divisor), expressions.py.span(divisor)
    match expressions.kind(read):
        case m.Type("int", ()):
            return m.ExpressionStatement(
                _quotient(read),
                span=span,
            )
        case m.Type("float" | "double", ()):
            is_zero = m.Binary("==", m.Paren(read), m.IntLiteral(0))
            number = m.Conditional(is_zero, m.IntLiteral(0), m.IntLiteral(1))
            return m.ExpressionStatement(_quotient(number), span=span)
        case _:
            raise expressions.unread(divisor, "this may be zero where it is divided by")


def _quotient(divisor: m.Expression) -> m.Expression:
    is_one = isinstance(divisor, m.Name | m.Member | m.Index)
    return m.Binary("/", m.IntLiteral(1), divisor if is_one else m.Paren(divisor))


def _divisor(node: Node) -> Node | None:
    """What an operator or the run-time part divides by; None where that is a number, not zero."""
    match node.type:
        case "binary_operator" if text_of(field(node, "operator")) in _DIVIDING:
            by = field(node, "right") if field(node, "left").type not in _TEXTS else None
        case "call" if text_of(field(node, "function")).rpartition(".")[2] in _DIVIDING_BY_NAME:
            arguments = named(field(node, "arguments"))
            by = arguments[1] if len(arguments) == 2 else None
        case _:
            return None
    return None if by is None or _is_other_than_zero(by) else by


def _is_other_than_zero(node: Node) -> bool:
    number = number_of(node) if node.type in ("integer", "float") else None
    return number is not None and number != 0


def _is_element(expressions: ModelExpressionReader, node: Node) -> bool:
    """Whether it is the element of an array of the model by an index that is not written out."""
    if node.type != "subscript" or field(node, "subscript").type == "integer":
        return False
    try:
        held = expressions.expression(field(node, "value"))
    except Unread:
        return False
    type_ = idioms.type_of(expressions, held)
    is_array = type_ is not None and bool(type_.dimensions)
    return is_array and not expressions.names.silent.exceptions.is_within(node)
