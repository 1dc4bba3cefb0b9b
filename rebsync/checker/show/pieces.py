"""Styled text for terminals: lines that break between words and hang below their beginning."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable, Iterator, Sequence
from typing import TextIO
from unicodedata import combining, east_asian_width

from rebsync.records import dataclass
from rebsync.report_text import Piece, coloured
from rebsync.terminal import has_colours, one_line, without_commands

NARROWEST = 40
_WORD = re.compile(r"\s*\S+|\s+")


@dataclass(frozen=True, slots=True)
class Line:
    """One line of pieces; what does not fit goes on `hang` columns from the left."""

    pieces: tuple[Piece, ...]
    hang: int = 0


def line(*pieces: Piece | str, hang: int = 0) -> Line:
    """A line of pieces; plain text has no style."""
    made = (p if isinstance(p, Piece) else Piece(p) for p in pieces)
    return Line(tuple(Piece(one_line(p.text), p.style) for p in made), hang)


def plain(lines: Iterable[Line], width: int | None = None) -> str:
    """The text of lines without styles, broken at a width if there is one."""
    return without_commands("".join(piece.text for piece in _broken(lines, width)))


def print_lines(lines: Sequence[Line], stream: TextIO) -> None:
    """Writes lines: on a terminal at its width and in colours, elsewhere each as one line."""
    if not stream.isatty():
        stream.write(plain(lines))
        return
    width = max(shutil.get_terminal_size().columns, NARROWEST)
    if not has_colours(stream):
        stream.write(plain(lines, width))
        return
    stream.write(without_commands(coloured(_broken(lines, width))))


def columns(text: str) -> int:
    """How many columns of a terminal, or cells of a fixed-width font, a text takes."""
    if text.isascii():
        return len(text)
    return sum(0 if combining(c) else 2 if east_asian_width(c) in "WF" else 1 for c in text)


def _broken(lines: Iterable[Line], width: int | None) -> Iterator[Piece]:
    for each in lines:
        yield from each.pieces if width is None else _fitted(each, width)
        yield Piece("\n")


def _fitted(whole: Line, width: int) -> Iterator[Piece]:
    """The pieces of a line, with line ends where the next word would pass the width."""
    at = 0
    for word in _words(whole.pieces):
        text = "".join(piece.text for piece in word)
        if at + columns(text) > width and at > whole.hang and text[0].isspace():
            yield Piece("\n" + " " * whole.hang)
            word = [Piece(word[0].text.lstrip(), word[0].style), *word[1:]]
            at, text = whole.hang, text.lstrip()
        yield from word
        at += columns(text)


def _words(pieces: Iterable[Piece]) -> Iterator[list[Piece]]:
    """Words, each with the blanks before it; what pieces say without a blank between is one."""
    word: list[Piece] = []
    for piece in pieces:
        for part in _WORD.findall(piece.text):
            if part[0].isspace() and word:
                yield word
                word = []
            word.append(Piece(part, piece.style))
    if word:
        yield word
