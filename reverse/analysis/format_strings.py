"""Texts that `str.format` fills in, as Python's format string syntax has them."""

from __future__ import annotations

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
