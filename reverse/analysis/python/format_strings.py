"""Texts that `str.format` and `%` fill in, as Python has them."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from string import Formatter
from typing import TypeVar

from rebsync.reverse.analysis.python.value_types import OwnType

T = TypeVar("T")


def has_pieces(text: str, by_place: int, names: Collection[str]) -> bool:
    """Whether all that a text has to be filled in is among the arguments, and is nothing else."""
    try:
        fields = list(_fields(text))
    except ValueError:
        return False
    automatic = sum(not field for field in fields)
    numbers = [int(field) for field in fields if field.isdecimal()]
    if automatic > by_place or any(number >= by_place for number in numbers):
        return False
    if automatic and numbers:
        return False
    return all(field in names for field in fields if field and not field.isdecimal())


def _fields(text: str) -> Iterator[str]:
    """The names of what is to be filled in, those within styles included."""
    for _, field, style, conversion in Formatter().parse(text):
        if conversion not in (None, *AS_TEXT):
            raise ValueError(conversion)
        if field is not None:
            yield field
            yield from _fields(style or "")


OF_NUMBERS = frozenset("bcdeEfFgGnoxX%")  # letters of styles that only numbers have


def styles_in(text: str) -> Iterator[tuple[int | str, str]]:
    """The styles in which a text has to be filled in, with the pieces: by place, or by name."""
    try:
        pieces = list(Formatter().parse(text))
    except ValueError:
        return
    for at, (_, field, style, conversion) in enumerate(p for p in pieces if p[1] is not None):
        if style and "{" not in style and not conversion:
            if not field:
                yield at, style
            elif field.isidentifier():
                yield field, style
            elif field.isdecimal():
                yield int(field), style


AS_TEXT = frozenset("sra")  # letters of conversions that take anything
_CONVERSION = re.compile(
    r"%(?:\((?P<key>[^)]*)\))?[#0\- +]*(?P<width>\*|\d+)?(?:\.(\*|\d+))?[hlL]?(.)"
)


def conversions(text: str) -> list[str] | None:
    """The letters of what `%` puts into a text, in order; None where it takes them by names.

    A width or precision that is given as well is a number: `d`.
    """
    found: list[str] = []
    for match in _CONVERSION.finditer(text):
        if match["key"] is not None:
            return None
        found += "d" * match[0].count("*")
        found += match[0][-1] if match[0][-1] != "%" else ""
    return found


def conversions_by_name(text: str) -> list[tuple[str, str]]:
    """The keys of what `%` puts into a text by names, each with the letter of its conversion."""
    found = (match for match in _CONVERSION.finditer(text) if match["key"] is not None)
    return [(match["key"], match[0][-1]) for match in found]


def numbers_of(text: str, values: Sequence[T], letters: Collection[str] | None = None) -> list[T]:
    """Those of some values that `%` puts into a text as numbers, or by one of some letters."""
    pairs = zip(conversions(text) or (), values, strict=False)
    is_asked = (lambda c: c not in AS_TEXT) if letters is None else letters.__contains__
    return [value for letter, value in pairs if is_asked(letter)]


def refuses(text: str, values: Sequence[Collection[OwnType | None]]) -> bool:
    """Whether `%` may not put values into a text, of which the types that each may have are known.

    There may be too many of them, or too few, or one of another type than the text asks for.
    """
    letters = conversions(text)
    if letters is None:
        return False
    if len(letters) != len(values) or "%" in _CONVERSION.sub("", text):
        return True
    return any(_is_refused(letter, kinds) for letter, kinds in zip(letters, values, strict=True))


def _is_refused(letter: str, kinds: Collection[OwnType | None]) -> bool:
    if letter in AS_TEXT:
        return False
    # A letter is put in by its number as well, but not by any number.
    return letter not in "diouxXeEfFgG" or not {OwnType.NUMBER}.issuperset(kinds)
