"""Expressions, types and annotations as sequences of token texts.

Parentheses come in only where the tree needs them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TypeVar

from rebsync import model as m
from rebsync import precedence

Words = list[str]
_Node = TypeVar("_Node")


def separated(words: Words, nodes: Iterable[_Node], write: Callable[[Words, _Node], None]) -> None:
    """The nodes with commas between them."""
    for number, node in enumerate(nodes):
        if number:
            words.append(",")
        write(words, node)


def listed(words: Words, nodes: Sequence[m.Expression]) -> None:
    """Expressions in parentheses."""
    words.append("(")
    separated(words, nodes, put_expression)
    words.append(")")


def put_annotations(words: Words, annotations: Iterable[m.Annotation]) -> None:
    """Annotations, one behind the other."""
    for annotation in annotations:
        words += ("@", annotation.name)
        if annotation.arguments is not None:
            listed(words, annotation.arguments)


def put_type(words: Words, node: m.Type) -> None:
    """A type with its dimensions."""
    words.append(node.name)
    for length in node.dimensions:
        words += ("[", str(length), "]")


def put_expression(words: Words, node: m.Expression, least: int = precedence.LOWEST) -> None:
    """An expression in a place where only operators that bind at least so tightly may stand."""
    level = precedence.binding(node)
    if level < least:
        words.append("(")
        _bare_expression(words, node, level)
        words.append(")")
    else:
        _bare_expression(words, node, level)


def _bare_expression(words: Words, node: m.Expression, level: int) -> None:
    match node:
        case m.Binary() | m.InstanceOf():
            _chain(words, node)
        case m.Unary(operator, operand):
            words.append(operator)
            put_expression(words, operand, precedence.PREFIX)
        case m.Postfix(operator, operand):
            put_expression(words, operand, precedence.POSTFIX)
            words.append(operator)
        case m.Cast(type_, operand):
            words.append("(")
            put_type(words, type_)
            words.append(")")
            put_expression(words, operand, precedence.CAST)
        case m.Assign(operator, target, value):
            put_expression(words, target, precedence.CHAIN)
            words.append(operator)
            put_expression(words, value)
        case m.Conditional(condition, then, otherwise):
            put_expression(words, condition, precedence.CHAIN)
            words.append("?")
            put_expression(words, then)
            words.append(":")
            put_expression(words, otherwise)
        case _:
            _primary(words, node)


def _chain(words: Words, node: m.Binary | m.InstanceOf) -> None:
    """Left operands are a loop: a sum may have more terms than Python's stack is deep."""
    links: list[m.Binary | m.InstanceOf] = []
    first: m.Expression = node
    level = precedence.LOWEST
    while isinstance(first, m.Binary | m.InstanceOf) and precedence.binding(first) >= level:
        links.append(first)
        level = precedence.binding(first)
        first = first.left if isinstance(first, m.Binary) else first.operand
    put_expression(words, first, level)
    for link in reversed(links):
        if isinstance(link, m.Binary):
            words.append(link.operator)
            put_expression(words, link.right, precedence.binding(link) + 1)
        else:
            words.append("instanceof")
            put_type(words, link.type)


def _primary(words: Words, node: m.Expression) -> None:
    match node:
        case m.Member(target, name):
            put_expression(words, target, precedence.PRIMARY)
            words += (".", name)
        case m.Index(target, index):
            put_expression(words, target, precedence.PRIMARY)
            words.append("[")
            put_expression(words, index)
            words.append("]")
        case m.Call():
            _call(words, node)
        case m.Paren(inner):
            listed(words, (inner,))
        case m.Choice(options):
            words.append("?")
            listed(words, options)
        case m.New(type_, bindings, arguments):
            words.append("new")
            put_type(words, type_)
            listed(words, bindings)
            words.append(":")
            listed(words, arguments)
        case _:
            words.extend(_atom(node))


def _call(words: Words, node: m.Call) -> None:
    if node.target is not None:
        put_expression(words, node.target, precedence.PRIMARY)
        words.append(".")
    words.append(node.name)
    listed(words, node.arguments)
    for keyword, value in (("after", node.after), ("deadline", node.deadline)):
        if value is not None:
            words.append(keyword)
            listed(words, (value,))


def _atom(node: m.Expression) -> tuple[str, ...]:
    match node:
        case m.IntLiteral(value):
            return ("-", str(-value)) if value < 0 else (str(value),)
        case m.FloatLiteral(text) | m.StringLiteral(text):
            return (text,)
        case m.BoolLiteral(value):
            return ("true" if value else "false",)
        case m.NullLiteral():
            return ("null",)
        case m.Name(name):
            return (name,)
        case m.Self():
            return ("self",)
        case m.Super():
            return ("super",)
        case _:
            raise ValueError(f"a tree with mistakes cannot be printed: {type(node).__name__}")
