"""The lines between the states of a drawing, and how far apart its levels have to be for them.

An edge to the next level is a straight line. Every other edge leaves its state downwards, runs in
the gap below, up or down a channel on the right, and comes in from above. A gap has rows for these
lines and for labels, so that they do not cover each other.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import field, replace

from rebsync.checker.show.chart_rows import width_of
from rebsync.checker.show.flights import lanes
from rebsync.checker.show.space import SpaceEdge
from rebsync.records import dataclass

ROW = 15.0
MARGIN = 24.0
LOOP = 30.0  # from a node to the label of an edge back to it
_PAD = 7.0
_PORT = 11.0  # the least distance between lines at a node
_EDGE = 16.0  # the height of a gap above and below its rows
_CHANNEL = 9.0


@dataclass
class Node:
    """A state, or a failure (`number` None), with its place: the middle of its upper side.

    `ports` is how many lines meet it above or below.
    """

    number: int | None
    level: int
    lines: tuple[str, ...]
    ports: int = 1
    x: float = 0.0
    top: float = 0.0

    @property
    def width(self) -> float:
        text = max(width_of(line) for line in self.lines)
        return max(text, self.ports * _PORT) + 2 * _PAD

    @property
    def height(self) -> float:
        return len(self.lines) * ROW + _PAD

    @property
    def bottom(self) -> float:
        return self.top + self.height


@dataclass
class Line:
    """One edge, or several that say the same: its points, and the left end of its label.

    `leaves`, `enters` and `channel` are where it runs up or down, from left to right.
    """

    edge: SpaceEdge
    source: Node
    target: Node
    label: str
    leaves: float = 0.0
    enters: float = 0.0
    channel: float = 0.0
    points: list[tuple[float, float]] = field(default_factory=list)
    at: tuple[float, float] = (0.0, 0.0)

    @property
    def loops(self) -> bool:
        """Whether it comes back to where it starts."""
        return self.source is self.target

    @property
    def falls(self) -> bool:
        """Whether it goes straight to the next level."""
        return self.target.level == self.source.level + 1

    @property
    def goes_around(self) -> bool:
        """Whether it needs a channel."""
        return not self.loops and not self.falls

    @property
    def wide(self) -> float:
        """The width of the label."""
        return width_of(self.label)


@dataclass(frozen=True, slots=True)
class _Gap:
    """The rows below a level: of lines that leave it, of labels, of lines that enter the next.

    Rows are numbered from the top, those of each kind from 0; lines go by their `id`.
    """

    leaving: dict[int, int]
    labels: dict[int, int]
    entering: dict[int, int]
    rows: tuple[int, int, int]

    @property
    def height(self) -> float:
        return 2 * _EDGE + sum(self.rows) * ROW

    def y(self, kind: int, row: int) -> float:
        """The lower edge of a row, from the top of the gap."""
        return _EDGE + (sum(self.rows[:kind]) + row + 1) * ROW - 4


def route(rows: list[list[Node]], lines: list[Line]) -> tuple[float, float]:
    """Places levels and lines; the width and height of it all."""
    _set_ports(lines)
    right = max((node.x + node.width / 2 for row in rows for node in row), default=0.0)
    right = max([right, *(_loop_end(line) for line in lines if line.loops)])
    _set_channels([line for line in lines if line.goes_around], right + MARGIN)
    gaps = [_gap(level, row, lines) for level, row in enumerate([[], *rows], -1)]
    tops = _levels_down(rows, gaps)
    for line in lines:
        if line.loops:
            _loop(line)
        elif line.falls:
            _fall(line, gaps[line.source.level + 1], tops[line.source.level + 1])
        else:
            _go_around(line, gaps, tops)
    right = max([right, *(max(line.channel, line.at[0] + line.wide) for line in lines)])
    return right + MARGIN, tops[-1] + gaps[-1].height


# --- from left to right ------------------------------------------------------------------------


def _set_ports(lines: list[Line]) -> None:
    """Where lines meet their nodes: side by side, in the order of their other ends."""
    out: dict[int, list[Line]] = defaultdict(list)
    into: dict[int, list[Line]] = defaultdict(list)
    for line in lines:
        if not line.loops:
            out[id(line.source)].append(line)
            into[id(line.target)].append(line)
    for members in out.values():
        members.sort(key=lambda line: (line.goes_around, line.target.x))
        for line, x in zip(members, _side_by_side(members[0].source, len(members)), strict=True):
            line.leaves = x
    for members in into.values():
        members.sort(key=lambda line: (line.goes_around, line.source.x))
        for line, x in zip(members, _side_by_side(members[0].target, len(members)), strict=True):
            line.enters = x


def _side_by_side(node: Node, count: int) -> list[float]:
    room = node.width - 2 * _PAD
    return [node.x + room * ((place + 0.5) / count - 0.5) for place in range(count)]


def _set_channels(around: list[Line], left: float) -> None:
    """Channels for the lines that go around, as few as they need."""

    def span(line: Line) -> tuple[float, float]:
        low, high = sorted((line.source.level + 0.5, line.target.level - 0.5))
        return low, high

    ordered = sorted(around, key=span)
    for line, lane in zip(ordered, lanes(map(span, ordered)), strict=True):
        line.channel = left + lane * _CHANNEL


# --- gaps --------------------------------------------------------------------------------------


def _gap(level: int, row: list[Node], lines: list[Line]) -> _Gap:
    """The gap below the nodes of a level; -1 is the one above the first."""
    around = [line for line in lines if line.goes_around]
    leaving = _rows_for([(x, x.leaves) for x in around if x.source.level == level])
    entering = _rows_for([(x, x.enters) for x in around if x.target.level == level + 1])
    falling = [line for line in lines if line.falls and line.source.level == level]
    tallest = max((node.height for node in row), default=0.0)
    for count in range(len(falling) + 1):
        gap = _Gap(leaving, {}, entering, (_size(leaving), count, _size(entering)))
        labels = _labels(falling, gap, tallest)
        if labels is not None:
            break
    return replace(gap, labels=labels or {})


def _rows_for(members: list[tuple[Line, float]]) -> dict[int, int]:
    """Rows for the level parts of lines, from their nodes to their channels."""
    members = sorted(members, key=lambda member: member[1])
    given = lanes((x, line.channel) for line, x in members)
    return {id(line): row for (line, _), row in zip(members, given, strict=True)}


def _size(rows: dict[int, int]) -> int:
    return max(rows.values(), default=-1) + 1


def _crossing(line: Line, gap: _Gap, row: int, above: float) -> float:
    """Where a line crosses a row of labels; it begins `above` the gap, and ends with it."""
    part = (gap.y(1, row) - 4 + above) / (gap.height + above)
    return line.leaves + (line.enters - line.leaves) * part


def _labels(falling: list[Line], gap: _Gap, tallest: float) -> dict[int, int] | None:
    """A row for each label, so that none covers another; None when there are too few rows."""
    taken: list[list[tuple[float, float]]] = [[] for _ in range(gap.rows[1])]
    found: dict[int, int] = {}
    for line in sorted(falling, key=lambda line: line.leaves + line.enters):
        half = line.wide / 2 + 4
        for row in _from_middle(gap.rows[1]):
            x = _crossing(line, gap, row, tallest - line.source.height)
            if all(x + half < start or x - half > end for start, end in taken[row]):
                taken[row].append((x - half, x + half))
                found[id(line)] = row
                break
        else:
            return None
    return found


def _from_middle(count: int) -> Iterable[int]:
    return sorted(range(count), key=lambda row: abs(row - (count - 1) / 2))


def _levels_down(rows: list[list[Node]], gaps: list[_Gap]) -> list[float]:
    """Places the levels below each other; where each gap begins, the one above them first."""
    y = MARGIN / 2
    tops = []
    for gap, row in zip(gaps, [*rows, []], strict=True):
        tops.append(y)
        y += gap.height
        for node in row:
            node.top = y
        y = max((node.bottom for node in row), default=y)
    return tops


# --- points ------------------------------------------------------------------------------------


def _fall(line: Line, gap: _Gap, top: float) -> None:
    row = gap.labels[id(line)]
    line.points = [(line.leaves, line.source.bottom), (line.enters, line.target.top)]
    x = _crossing(line, gap, row, top - line.source.bottom)
    line.at = (x - line.wide / 2, top + gap.y(1, row))


def _go_around(line: Line, gaps: list[_Gap], tops: list[float]) -> None:
    below, above = line.source.level + 1, line.target.level
    low = tops[below] + gaps[below].y(0, gaps[below].leaving[id(line)])
    high = tops[above] + gaps[above].y(2, gaps[above].entering[id(line)])
    start, end = (line.leaves, line.source.bottom), (line.enters, line.target.top)
    around = [(start[0], low), (line.channel, low), (line.channel, high), (end[0], high)]
    line.points = [start, *around, end]
    line.at = (start[0] + 5, low - 3)


def _loop(line: Line) -> None:
    node = line.source
    x, y = node.x + node.width / 2, node.top + node.height / 2
    line.points = [(x, y - 5), (x + 18, y - 5), (x + 18, y + 5), (x, y + 5)]
    line.at = (x + 23, y + 4)


def _loop_end(line: Line) -> float:
    return line.source.x + line.source.width / 2 + LOOP + line.wide
