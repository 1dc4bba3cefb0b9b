"""Lines of text under construction: indentation, comments, and folding of what is too long."""

from __future__ import annotations

from dataclasses import field

from rebsync.records import dataclass
from rebsync.spacing import Spacing

WIDTH = 100
_INDENT = 2
_FOLD_BEFORE = frozenset(("&&", "||", "?", "after", "deadline"))


@dataclass(frozen=True, slots=True)
class Token:
    """A token or comment; `line` and `column` count from 1, 0 says that it has no place."""

    text: str
    line: int = 0
    column: int = 0

    @property
    def end_line(self) -> int:
        return self.line + self.text.count("\n")


@dataclass(slots=True)
class _Item:
    text: str
    blank: str
    depth: int
    breaks: bool


@dataclass(slots=True)
class Lines:
    """The finished lines, and the items of the one under construction."""

    done: list[str] = field(default_factory=list)
    indent: int = 0
    _items: list[_Item] = field(default_factory=list)
    _spacing: Spacing = field(default_factory=Spacing)
    _broken: bool = False

    @property
    def empty(self) -> bool:
        """Whether the line under construction has nothing yet."""
        return not self._items

    def add(self, text: str, choice: bool = False) -> None:
        """Put a token or an inner comment at the end of the line."""
        depth = self._spacing.depth - (text in (")", "]", "}"))
        blank = self._spacing.blank(text, choice)
        if text.startswith("//") and self._items:
            blank = "  "
        self._items.append(_Item(text, blank, depth, self._broken))
        self._broken = text.startswith("//")

    def begin_operand(self) -> None:
        """What follows an annotation is the start of something, not its continuation."""
        self._spacing.begin_operand()

    def row(self) -> str:
        """The line under construction, however long."""
        return "".join(item.blank + item.text for item in self._items)

    def break_line(self) -> None:
        """What follows goes on in a further row of the same line."""
        self._broken = True

    def blank(self) -> None:
        """One empty line, unless there is one or nothing yet."""
        if self.done and self.done[-1]:
            self.done.append("")

    def end(self) -> None:
        """Finish the line under construction."""
        margin = " " * (_INDENT * self.indent)
        for number, row in enumerate(self._rows(len(margin))):
            text = "".join(item.blank + item.text for item in row).strip(" ")
            self.done.append(margin + self._continuation(row, number) + text)
        self._items = []
        self._spacing = Spacing()
        self._broken = False

    def trail(self, comment: str) -> None:
        """A comment after the line just finished."""
        self.done[-1] += "  " + comment

    def comment(self, text: str, column: int) -> None:
        """A comment on lines of its own; its further lines move with the first."""
        margin = " " * (_INDENT * self.indent)
        first, *rest = text.split("\n")
        self.done.append(margin + first)
        shift = len(margin) - (column - 1)
        self.done.extend(_shifted(line, shift) for line in rest)

    def _continuation(self, row: list[_Item], number: int) -> str:
        closing = number == 0 or self._items[0].text == "}" or row[0].text in ("{", "else")
        return "" if closing else " " * (2 * _INDENT)

    def _rows(self, margin: int) -> list[list[_Item]]:
        hard: list[list[_Item]] = []
        for item in self._items:
            if item.breaks or not hard:
                hard.append([])
            hard[-1].append(item)
        rows: list[list[_Item]] = []
        for row in hard:
            rows.extend(_folded(row, margin, 2 * _INDENT * bool(rows)))
        return rows


def _folded(row: list[_Item], margin: int, extra: int) -> list[list[_Item]]:
    """Rows within WIDTH where that is possible, broken at the outermost bracket level."""
    rows: list[list[_Item]] = []
    start = 0
    while True:
        at = _fold_place(row, start, WIDTH - margin - extra)
        if at is None:
            return [*rows, row[start:]]
        rows.append(row[start:at])
        start, extra = at, 2 * _INDENT


def _fold_place(row: list[_Item], start: int, width: int) -> int | None:
    best: int | None = None
    used = len(row[start].text)
    for i in range(start + 1, len(row)):
        item = row[i]
        if item.text.startswith("//"):
            break
        if row[i - 1].text == "," or item.text in _FOLD_BEFORE:
            if used > width and best is not None:
                return best
            if best is None or item.depth <= row[best].depth:
                best = i
        used += len(item.blank) + len(item.text)
    return best if used > width else None


def _shifted(line: str, shift: int) -> str:
    if shift >= 0:
        return (" " * shift + line).rstrip()
    blank = len(line) - len(line.lstrip())
    return line[min(-shift, blank) :].rstrip()


def shown(comment: str) -> str:
    """A comment as it is printed: without `\\r` and blanks at line ends."""
    return "\n".join(line.rstrip() for line in comment.replace("\r\n", "\n").split("\n"))
