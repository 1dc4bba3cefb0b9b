"""Documents: text with places where it may be broken, and the choice of these (Oppen 1980, Wadler
2003), with the two additions of ruff's formatter that Python's optional parentheses need.

A group is broken as a whole or not at all: it is not where all up to the next line break fits.
"""

from __future__ import annotations

from dataclasses import field
from enum import Enum, auto
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.unions import assert_never

STEP = 4  # columns of an indentation


@dataclass(frozen=True, slots=True)
class Line:
    """A line break where its group is broken; else `flat`."""

    flat: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Group:
    """What is broken as a whole; `number` is what conditions name it by."""

    content: Document
    number: int = 0


@dataclass(frozen=True, slots=True)
class Indent:
    """Lines that begin further to the right; only where a group is broken, if it is named."""

    content: Document
    of: int = 0


@dataclass(frozen=True, slots=True)
class Either:
    """One of two contents, as a group is broken or not: the named one, or that around."""

    broken: Document
    flat: Document = ""
    of: int = 0


@dataclass(frozen=True, slots=True)
class MayExpand:
    """Within a group that is not broken, something that may have line breaks all the same."""

    content: Document
    of: int


@dataclass(frozen=True, slots=True)
class BestFit:
    """A content that is in parentheses if all its lines fit only then."""

    content: Document
    of: int


@dataclass(frozen=True, slots=True)
class FirstFit:
    """The first of some contents whose first line fits, unbroken or broken; else the last."""

    unbroken: Document
    others: tuple[Document, ...]


Document: TypeAlias = (
    "str | tuple[Document, ...] | Line | Group | Indent | Either | MayExpand | BestFit | FirstFit"
)
_Command: TypeAlias = "tuple[int, bool, Document]"  # columns before, whether broken, content


def printed(document: Document, columns: int, width: int) -> list[str]:
    """The lines of a document that starts at a column."""
    printer = _Printer(width, columns)
    printer.write(document)
    return "".join(printer.out).split("\n")


class _Measure(Enum):
    """Which lines have to fit."""

    FIRST = auto()
    ALL = auto()
    LOOSE = auto()  # what is in brackets that may expand need not fit, only what is behind them


@dataclass(slots=True)
class _Printer:
    width: int
    start: int
    column: int = 0
    out: list[str] = field(default_factory=list)
    broken: dict[int, bool] = field(default_factory=dict)

    def write(self, document: Document) -> None:
        self._put(" " * self.start)
        waiting: list[_Command] = [(self.start, True, document)]
        while waiting:
            columns, is_broken, content = waiting.pop()
            match content:
                case str():
                    self._put(content)
                case Line(flat):
                    self._line(columns) if is_broken else self._put(flat)
                case Group(inner, number):
                    breaks = is_broken and not self._fits((columns, False, content), waiting)
                    self.broken[number] = breaks
                    waiting.append((columns, breaks, inner))
                case MayExpand(inner, of):
                    waiting.append((columns, is_broken or not self._is_broken(of), inner))
                case BestFit():
                    waiting.append(self._best(content, columns, waiting))
                case FirstFit():
                    waiting.append(self._first(content, columns, waiting))
                case _:
                    waiting += self._parts(columns, is_broken, content)

    def _best(self, content: BestFit, columns: int, waiting: list[_Command]) -> _Command:
        """A content without parentheses unless it fits only in them."""
        plain = columns, False, content.content
        inside = columns, True, ("(", Indent((Line(), content.content)), Line(), ")")
        self.broken[content.of] = False
        if self._fits(plain, waiting):
            return plain
        self.broken[content.of] = True
        if self._fits(inside, waiting, expands=True):
            return inside
        self.broken[content.of] = False
        return plain

    def _first(self, content: FirstFit, columns: int, waiting: list[_Command]) -> _Command:
        unbroken = columns, False, content.unbroken
        broken = [(columns, True, c) for c in content.others]
        return next((c for c in (unbroken, *broken) if self._fits(c, waiting)), broken[-1])

    def _put(self, text: str) -> None:
        self.out.append(text)
        self.column += len(text)

    def _line(self, columns: int) -> None:
        self.out.append("\n" + " " * columns)
        self.column = columns

    def _is_broken(self, number: int) -> bool:
        return self.broken.get(number, False)

    def _parts(self, columns: int, is_broken: bool, content: Document) -> list[_Command]:
        """What a content without a choice is made of, the first last."""
        match content:
            case tuple():
                return [(columns, is_broken, c) for c in reversed(content)]
            case Indent(inner, of):
                further = columns + STEP * (not of or self._is_broken(of))
                return [(further, is_broken, inner)]
            case Either(broken, flat, of):
                chosen = self._is_broken(of) if of else is_broken
                return [(columns, is_broken, broken if chosen else flat)]
            case str() | Line() | Group() | MayExpand() | BestFit() | FirstFit():
                raise AssertionError(content)
            case _:
                assert_never(content)

    def _fits(self, first: _Command, rest: list[_Command], expands: bool = False) -> bool:
        """Whether all up to the next line break fits into the line, what may expand expanded.

        `expands` asks whether all lines of the first content do.
        """
        column = self.column
        waiting = [(*first, _Measure.ALL if expands else _Measure.FIRST)]
        after = len(rest)
        while waiting or after:
            if not waiting:
                after -= 1
                waiting.append((*rest[after], _Measure.FIRST))
            columns, is_broken, content, measure = waiting.pop()
            match content:
                case str():
                    column += len(content)
                case Line() if is_broken and measure is _Measure.FIRST:
                    return True
                case Line(flat):
                    column = columns if is_broken else column + len(flat)
                case Group(inner, number):
                    self.broken[number] = is_broken
                    waiting.append((columns, is_broken, inner, measure))
                case MayExpand(inner, of):
                    opens = not is_broken and not self._is_broken(of)
                    inside = _Measure.LOOSE if opens else measure
                    waiting.append((columns, is_broken or opens, inner, inside))
                case BestFit(inner) | FirstFit(inner):
                    waiting.append((columns, is_broken, inner, measure))
                case _:
                    parts = self._parts(columns, is_broken, content)
                    waiting += [(*part, measure) for part in parts]
            may_overflow = measure is _Measure.LOOSE and content not in ("(", "[")
            if column > self.width and not may_overflow:
                return False
        return True
