"""Places in a source text."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import field
from functools import cached_property

from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Span:
    """A half-open range of character offsets in one source text."""

    start: int
    end: int

    def to(self, other: Span) -> Span:
        """The range from the start of this span to the end of `other`."""
        return Span(self.start, other.end)

    def holds(self, inner: Span) -> bool:
        """Whether another range lies in this one, or is the same."""
        return self.start <= inner.start and inner.end <= self.end


NOWHERE = Span(0, 0)


@dataclass(frozen=True, slots=True)
class Position:
    """A line and a column, both counted from 1; columns count characters."""

    line: int
    column: int


@dataclass(frozen=True)
class Source:
    """A text together with the path it is known by (`-` for standard input)."""

    path: str
    text: str = field(repr=False)

    @cached_property
    def _line_starts(self) -> list[int]:
        starts = [0]
        find = self.text.find
        at = find("\n")
        while at >= 0:
            starts.append(at + 1)
            at = find("\n", at + 1)
        return starts

    def position(self, offset: int) -> Position:
        """The line and column of a character offset."""
        line = bisect_right(self._line_starts, offset)
        return Position(line, offset - self._line_starts[line - 1] + 1)

    def start_of(self, number: int) -> int:
        """The offset at which a line begins, counted from 1."""
        return self._line_starts[number - 1]

    def line(self, number: int) -> str:
        """The text of a line, counted from 1, without its line end."""
        start = self._line_starts[number - 1]
        end = self.text.find("\n", start)
        return self.text[start : end if end >= 0 else len(self.text)].rstrip("\r")

    def slice(self, span: Span) -> str:
        """The text that a span covers."""
        return self.text[span.start : span.end]

    def within(self, span: Span) -> SourceSpan:
        """A span of this text that tells whose it is."""
        return SourceSpan(span.start, span.end, self)


@dataclass(frozen=True, slots=True)
class SourceSpan(Span):
    """A range that knows its text, as in models that are read from several files."""

    source: Source = field(compare=False, repr=False)

    def to(self, other: Span) -> SourceSpan:
        """The range from the start of this span to the end of `other`, in this text."""
        return SourceSpan(self.start, other.end, self.source)
