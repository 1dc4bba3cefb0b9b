"""Literals of C++ as literals of the model."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.syntax.cpp_calls import string_of
from rebsync.reverse.syntax.cpp_numerals import numeral
from rebsync.reverse.syntax.cpp_texts import unescaped
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of
from rebsync.terminal import with_escapes

_HEX = ("0x", "0X")  # the model has no such fractions
_MOST = (1 << 31) - 1  # that an `int` holds
_AROUND = frozenset({"binary_expression", "unary_expression", "cast_expression"})


def literal(cpp: Cpp, node: Node) -> m.Expression:
    """The literal; `Unread` where a node is none, or one that the model cannot say."""
    text, span = text_of(node), cpp.span(node)
    match node.type:
        case "number_literal":
            return _number(text.replace("'", ""), cpp, node)
        case "true" | "false":
            return m.BoolLiteral(text == "true", span)
        case "char_literal" if (code := _character(text)) is not None:
            return m.IntLiteral(code, span)
        case "string_literal" if text.startswith('"'):
            return m.StringLiteral(with_escapes(text.replace("?\\?", "??")), span)
        case "concatenated_string":
            whole = string_of(node)
            if whole is not None:
                return m.StringLiteral(with_escapes(f'"{whole}"'.replace("?\\?", "??")), span)
            raise Unread(span, "the model has no such texts")
        case "identifier" if text == "kNull":
            return m.NullLiteral(span)
        case "identifier" if text == "INT32_MIN":
            return m.Unary("-", m.IntLiteral(0x80000000, span), span)
        case "identifier":
            raise Unread(span, f'"{text}" is no variable of the model')
        case _:
            raise Unread(span, f"the model cannot say this: {node.type.replace('_', ' ')}")


def text_in(node: Node) -> str | None:
    """The text that a literal stands for; None where it is not known."""
    whole = string_of(node)
    plain = unescaped(whole) if whole is not None else None
    return None if plain is None or "\0" in plain else plain


def _character(text: str) -> int | None:
    """The number that a character stands for."""
    inner = unescaped(text[1:-1])
    return ord(inner) if inner is not None and len(inner) == 1 and inner.isascii() else None


def _number(text: str, cpp: Cpp, node: Node) -> m.Expression:
    span = cpp.span(node)
    if text[0] in "+-":  # the parser takes a sign before a digit as part of the number
        return m.Unary(text[0], _number(text[1:].lstrip(), cpp, node), span)
    found = numeral(text)
    if found is None or (found.whole is None and found.digits.startswith(_HEX)):
        raise Unread(span, f'the model has no number "{text}"')
    if found.whole is not None:
        return m.IntLiteral(found.whole, span)
    return m.FloatLiteral(model_float(found.digits, found.suffix), span)


def lower(value: int) -> int:
    """The number that the model's `int` makes of a whole one: its lower 32 bits."""
    bits = value & 0xFFFFFFFF
    return bits - (1 << 32) if bits >> 31 else bits


def in_range(read: m.Expression, node: Node) -> m.Expression:
    """An integer that no `int` holds as the one that its lower bits are."""
    match read:
        case m.IntLiteral(value, span) if value > _MOST:
            if value == _MOST + 1 and _is_negated(node):
                return read
        case m.Unary("-", m.IntLiteral(value), span) if value > _MOST + 1:
            value = -value
        case _:
            return read
    known = lower(value)
    return m.Unary("-", m.IntLiteral(-known), span) if known < 0 else m.IntLiteral(known, span)


def _is_negated(node: Node) -> bool:
    above = node.parent
    return above is not None and above.type == "unary_expression" and text_of(above)[0] == "-"


def is_bare_macro(cpp: Cpp, value: Node, use: Node) -> bool:
    """Whether a macro is an operation without parentheses that stands in another one."""
    above = value.parent
    beside = use.parent
    if value.type not in ("binary_expression", "conditional_expression") or beside is None:
        return False
    while above is not None and above.type != "declaration":
        above = above.parent
    made = above is not None and text_of(above).startswith("const auto x = ")
    return made and len(cpp.root.named_children) == 1 and beside.type in _AROUND


def model_float(digits: str, suffix: str) -> str:
    """A literal of the model, which is float unless it says double: the other way than in C++.

    `1.0F` is one that says float in the model as well, `1.0f` one that says nothing.
    """
    match suffix:
        case "f":
            return digits
        case "F":
            return f"{digits}f"
        case _:
            return f"{digits}d"
