"""Numbers of so many digits that to convert them takes long: Python's own limit is for servers."""

from __future__ import annotations

import sys

from rebsync.source import Span

MOST_DIGITS = 10_000  # to convert so many takes a millisecond, and ten times as many a hundred
_DIGITS = frozenset("0123456789_'")
_HEXADECIMAL = _DIGITS | frozenset("abcdefABCDEF")


def allow_long_numbers() -> None:
    """Lifts Python's limit of 4,300 digits; texts with numbers beyond MOST_DIGITS are refused."""
    if hasattr(sys, "set_int_max_str_digits"):  # since 3.10.7
        sys.set_int_max_str_digits(0)


def long_number(text: str) -> Span | None:
    """The first number of more than MOST_DIGITS digits in a text.

    Every such number holds one of the characters that are looked at, so this takes no time.
    """
    for at in range(MOST_DIGITS // 2, len(text), MOST_DIGITS // 2):
        if text[at] in _HEXADECIMAL:
            span = _around(text, at)
            if span is not None:
                return span
    return None


def _around(text: str, at: int) -> Span | None:
    """The number around a place, if it is too long: decimal, or hexadecimal after `0x`."""
    start, end = _stretch(text, at, _DIGITS)
    if end - start > MOST_DIGITS:
        return Span(start, end)
    start, end = _stretch(text, at, _HEXADECIMAL)
    is_number = text[max(start - 2, 0) : start].lower() == "0x"
    return Span(start, end) if is_number and end - start > MOST_DIGITS else None


def _stretch(text: str, at: int, digits: frozenset[str]) -> tuple[int, int]:
    start = end = at
    while start > 0 and text[start - 1] in digits:
        start -= 1
    while end < len(text) and text[end] in digits:
        end += 1
    return start, end
