"""Literals of Python: numbers, texts and formatted texts."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from warnings import catch_warnings, simplefilter

from tree_sitter import Node

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir.python.context import Lowering, NoLowering
from rebsync.reverse.ir.types import DOUBLE, NOTHING, TEXT, TRUTH, UNBOUNDED, UNKNOWN, Text, Type
from rebsync.reverse.syntax.py_tree import string_parts, text_of

_OCTAL_OF_OLD = re.compile(r"0[0-7]+")
_CONSTANTS: dict[str, tuple[bool | None, Type]] = {
    "true": (True, TRUTH),
    "false": (False, TRUTH),
    "none": (None, NOTHING),
}


def constant(ctx: Lowering, node: Node) -> e.Expression:
    """`True`, `False`, `None` or `...`."""
    if node.type == "ellipsis":
        return e.LibraryReference("builtins.Ellipsis", place=ctx.place(node))
    value, type_ = _CONSTANTS[node.type]
    return e.Literal(value, type_, text_of(node), ctx.place(node))


def number(ctx: Lowering, node: Node) -> e.Literal:
    """A number, Python 2's `0777` and `10L` included."""
    text = text_of(node)
    plain = text.replace("_", "").rstrip("lL")
    with suppress(ValueError):
        if plain[-1:] in "jJ":
            return e.Literal(complex(plain), UNKNOWN, text, ctx.place(node))
        if node.type == "float":
            return e.Literal(float(plain), DOUBLE, text, ctx.place(node))
        old = _OCTAL_OF_OLD.fullmatch(plain) is not None
        return e.Literal(int(plain, 8 if old else 0), UNBOUNDED, text, ctx.place(node))
    raise NoLowering("this number is too long or no number", node)


def string(ctx: Lowering, node: Node) -> e.Expression:
    """A text, a formatted one, or several one after the other."""
    pieces = node.named_children if node.type == "concatenated_string" else [node]
    texts = [p for p in pieces if p.type == "string"]
    if not any(_is_formatted(p) for p in texts):
        values = [_plain(p) for p in texts]
        joined = values[0]
        for value in values[1:]:
            joined = _joined(joined, value, node)
        type_ = Text(isinstance(joined, bytes))
        return e.Literal(joined, type_, text_of(node), ctx.place(node))
    parts = [shown for p in texts for part in _parts(p) for shown in _with_text(part)]
    operands = ctx.operands([partial(_piece, ctx, part) for part in parts])
    found = tuple(p for p in operands if isinstance(p, e.FormatPiece))
    dynamic = any(not isinstance(p.value, e.Literal) for p in found)
    return e.Format(found, TEXT, dynamic, ctx.place(node))


def _joined(left: str | bytes, right: str | bytes, node: Node) -> str | bytes:
    if isinstance(left, str) and isinstance(right, str):
        return left + right
    if isinstance(left, bytes) and isinstance(right, bytes):
        return left + right
    raise NoLowering("a text and bytes stand one after the other", node)


def _is_formatted(node: Node) -> bool:
    return "f" in _prefix(node)


def _prefix(node: Node) -> str:
    return text_of(node.children[0]).rstrip("\"'`").lower()


def _parts(node: Node) -> list[str | Node]:
    return string_parts(node) if _is_formatted(node) else [str(_plain(node))]


def _with_text(part: str | Node) -> Iterator[str | Node]:
    """A part of a formatted text, behind its own text where it is shown with that: `{x=}`."""
    children = [] if isinstance(part, str) else part.children
    sign = next((n for n, child in enumerate(children) if child.type == "="), None)
    if sign is not None and not isinstance(part, str):
        length = children[sign + 1].start_byte - part.start_byte
        yield (part.text or b"")[1:length].decode()
    yield part


def _plain(node: Node) -> str | bytes:
    """What a text without values in it says."""
    text = text_of(node)
    if text.startswith("`"):
        raise NoLowering("backticks", node)
    if _prefix(node) == "ur":
        text = "r" + text[2:]
    with suppress(SyntaxError, ValueError, MemoryError), catch_warnings():
        simplefilter("ignore")
        value = ast.literal_eval(text)
        if isinstance(value, str | bytes):
            return value
    return "".join(p for p in string_parts(node) if isinstance(p, str))


def _piece(ctx: Lowering, part: str | Node) -> e.FormatPiece:

    if isinstance(part, str):
        return e.FormatPiece(e.Literal(part, TEXT))
    shown = part.child_by_field_name("expression")
    if shown is None:
        raise NoLowering("a formatted value that is not Python", part)
    style = part.child_by_field_name("format_specifier")
    conversion = part.child_by_field_name("type_conversion")
    parts = [shown, *_computed(style)]
    value, *inner = ctx.values(parts)
    text = text_of(conversion) if conversion is not None else ""
    if not text and style is None and any(c.type == "=" for c in part.children):
        text = "!r"
    return e.FormatPiece(value, text, _style(ctx, style, inner))


def _computed(style: Node | None) -> list[Node]:
    """The values within a format."""
    found = [c for c in style.named_children if c.type == "format_expression"] if style else []
    for node in found:
        if len(node.named_children) != 1:
            raise NoLowering("a format of a format", node)
    return [node.named_children[0] for node in found]


def _style(ctx: Lowering, style: Node | None, values: list[e.Expression]) -> e.Expression | None:
    """How a value is made text: the words behind the colon, and values among them."""
    if style is None:
        return None
    if not values:
        return e.Literal(text_of(style)[1:], TEXT, "", ctx.place(style))
    pieces: list[e.FormatPiece] = []
    at = style.start_byte + 1
    inner = [c for c in style.named_children if c.type == "format_expression"]
    for node, value in zip(inner, values, strict=True):
        pieces += [_words(ctx, at, node.start_byte), e.FormatPiece(value)]
        at = node.end_byte
    pieces.append(_words(ctx, at, style.end_byte))
    return e.Format(tuple(pieces), TEXT, True, ctx.place(style))


def _words(ctx: Lowering, start: int, end: int) -> e.FormatPiece:
    return e.FormatPiece(e.Literal(ctx.py.data[start:end].decode("utf-8", "replace"), TEXT))
