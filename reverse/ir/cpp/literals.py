"""Literals of C++: numbers with their types ([lex.icon], [lex.fcon]), characters and texts."""

from __future__ import annotations

import re

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.conversions import holds
from rebsync.reverse.ir.cpp.types import CHAR, FLOAT, INT, LONG, SIZE, STRING, UNSIGNED
from rebsync.reverse.syntax.cpp_numerals import numeral
from rebsync.reverse.syntax.cpp_texts import unescaped
from rebsync.source import Span
from rebsync.static.constants import single

_RAW = re.compile(r'(?:u8)?R"([^(]*)\((.*)\)\1"\Z', re.DOTALL)


def number(text: str, place: Span) -> e.Literal | None:
    """A number; None where no type of ours has it."""
    found = numeral(text)
    if found is None:
        return None
    suffix, value = found.suffix.lower(), found.whole
    if value is None:
        return _floating(found.value, suffix, text, place)
    for type_ in (INT, UNSIGNED, LONG, SIZE):
        is_wide = type_.bits == 64
        if ("l" in suffix and not is_wide) or ("u" in suffix and type_.signed):
            continue
        if not type_.signed and found.is_decimal and "u" not in suffix:
            continue
        if holds(type_, value):
            return e.Literal(value, type_, text, place)
    return None


def _floating(value: float, suffix: str, text: str, place: Span) -> e.Literal | None:
    if suffix == "l":
        return None
    if suffix == "f":
        return e.Literal(single(value), FLOAT, text, place)
    return e.Literal(value, t.DOUBLE, text, place)


def character(text: str, place: Span) -> e.Literal | None:
    """A character of one byte, as the number that it is."""
    inner = unescaped(text[1:-1]) if text.startswith("'") else None
    if inner is None or len(inner) != 1 or ord(inner) > 127:
        return None
    return e.Literal(ord(inner), CHAR, text, place)


def string(text: str, place: Span) -> e.Literal | None:
    """A text in quotes."""
    raw = _RAW.match(text)
    if raw is not None:
        return e.Literal(raw[2], STRING, text, place)
    quoted = text.removeprefix("u8")
    inner = unescaped(quoted[1:-1]) if quoted.startswith('"') else None
    return None if inner is None else e.Literal(inner, STRING, text, place)
