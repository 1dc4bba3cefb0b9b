"""One finding for people: `file:line:col: code message`, the source line, a caret, the hint."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from unicodedata import east_asian_width

from rebsync.diagnostics import Diagnostic, Severity
from rebsync.records import dataclass
from rebsync.source import NOWHERE, Source, Span
from rebsync.terminal import named, one_line, printable

_WIDTH = 120
_CLIPPED = "..."
_STYLES = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow", Severity.NOTE: "bold cyan"}


@dataclass(frozen=True, slots=True)
class Piece:
    """A stretch of text and the style it has on a terminal."""

    text: str
    style: str = ""


# How terminals are told of the words of a style (ECMA-48, SGR).
_SGR = {
    "bold": 1,
    "dim": 2,
    "red": 31,
    "green": 32,
    "yellow": 33,
    "cyan": 36,
}


def coloured(pieces: Iterable[Piece]) -> str:
    """The text of pieces in their styles, for a terminal; no style goes on over a line end."""
    return "".join(map(_coloured, pieces))


def _coloured(piece: Piece) -> str:
    if not piece.style:
        return piece.text
    begin = f"\x1b[{';'.join(str(_SGR[word]) for word in piece.style.split())}m"
    lines = piece.text.split("\n")
    return "\n".join(f"{begin}{line}\x1b[0m" if line else "" for line in lines)


def finding_pieces(source: Source, diagnostic: Diagnostic) -> Iterator[Piece]:
    """The lines that show one diagnostic."""
    style = _STYLES[diagnostic.severity]
    yield Piece(_place(source, diagnostic.span), "bold")
    yield Piece(": ")
    yield Piece(diagnostic.code, style)
    yield Piece(f" {one_line(diagnostic.message)}\n")
    yield from _excerpt(source, diagnostic.span, style)
    if diagnostic.hint:
        yield Piece("hint: ", "bold green")
        yield Piece(f"{printable(diagnostic.hint)}\n")
    for span, remark in diagnostic.related:
        yield Piece(_place(source, span), "bold")
        yield Piece(f": note: {one_line(remark)}\n")
        yield from _excerpt(source, span, "cyan")


def _place(source: Source, span: Span) -> str:
    path = one_line(named(source.path))
    if span is NOWHERE:
        return path
    position = source.position(span.start)
    return f"{path}:{position.line}:{position.column}"


def _excerpt(source: Source, span: Span, style: str) -> Iterator[Piece]:
    if span is NOWHERE:
        return
    position = source.position(span.start)
    line = source.line(position.line)
    start = position.column - 1
    end = min(start + max(span.end - span.start, 1), max(len(line), start + 1))
    line, start, end = _clipped(line, start, end)
    yield Piece(f"  {one_line(line)}\n")
    blank = "".join("\t" if c == "\t" else " " * _width(c) for c in one_line(line[:start]))
    marked = sum(_width(c) for c in one_line(line[start:end]))
    yield Piece(f"  {blank}")
    yield Piece("^" + "~" * (max(marked, 1) - 1), style)
    yield Piece("\n")


def _clipped(line: str, start: int, end: int) -> tuple[str, int, int]:
    """A very long line cut down to the part around the place."""
    if len(line) <= _WIDTH:
        return line, start, end
    left = max(0, min(start - _WIDTH // 4, len(line) - _WIDTH))
    right = left + _WIDTH
    before = _CLIPPED if left else ""
    after = _CLIPPED if right < len(line) else ""
    shift = len(before) - left
    return before + line[left:right] + after, start + shift, min(end, right) + shift


def _width(character: str) -> int:
    return 2 if east_asian_width(character) in "WF" else 1
