"""Texts that `str.format` fills in, as Python's format string syntax has them."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from string import Formatter


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
    for _, field, style, _ in Formatter().parse(text):
        if field is not None:
            yield field
            yield from _fields(style or "")


OF_NUMBERS = frozenset("bcdeEfFgGnoxX%")  # letters of styles that only numbers have


def numbers_in(text: str) -> Iterator[int | str]:
    """What a text has to be filled in with as a number: by place, or by name."""
    try:
        pieces = list(Formatter().parse(text))
    except ValueError:
        return
    for at, (_, field, style, conversion) in enumerate(p for p in pieces if p[1] is not None):
        if style and style[-1] in OF_NUMBERS and "{" not in style and not conversion:
            if not field:
                yield at
            elif field.isidentifier():
                yield field
            elif field.isdecimal():
                yield int(field)


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
