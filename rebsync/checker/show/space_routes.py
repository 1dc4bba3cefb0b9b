"""The lines between the states of a drawing, and how far apart its levels have to be for them.

An edge to the next level is a straight line. Every other edge leaves its state downwards, runs in
the gap below, up or down a channel on the right, and comes in from above. A gap has rows for these
lines and for labels, so that they do not cover each other.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field

from rebsync.checker.show.chart_rows import width_of
from rebsync.checker.show.flights import lanes
from rebsync.checker.show.space import SpaceEdge

ROW = 15.0
MARGIN = 24.0
LOOP = 30.0  # from a node to the label of an edge back to it
_PAD = 7.0
_PORT = 11.0  # the least distance between lines at a node
_EDGE = 16.0  # the height of a gap above and below its rows
_CHANNEL = 9.0
_MOST_ROWS = 40


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
    """One edge, or several that say the same: its points, and the place of its label."""

    edge: SpaceEdge
    source: Node
    target: Node
    label: str
    points: list[tuple[float, float]] = field(default_factory=list)
    at: tuple[float, float] = (0.0, 0.0)  # its left end

    @property
    def loops(self) -> bool:
        """Whether it comes back to where it starts."""
        return self.source is self.target

    @property
    def falls(self) -> bool:
        """Whether it goes straight to the next level."""
        return self.target.level == self.source.level + 1


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
    out, into = _ports(lines, out=True), _ports(lines, out=False)
    wide = _right_end(rows, lines)
    around = [line for line in lines if not line.falls and not line.loops]
    channels = _channels(around, wide + MARGIN)
    gaps = [
        _gap(level, lines, around, out, into, channels, max((n.height for n in row), default=0.0))
        for level, row in enumerate([[], *rows], -1)
    ]
    tops = _levels_down(rows, gaps)
    for line in lines:
        start, end = (out[id(line)], line.source.bottom), (into[id(line)], line.target.top)
        if line.loops:
            _loop(line)
        elif line.falls:
            gap = gaps[line.source.level + 1]
            row = gap.labels[id(line)]
            x = _middle_of(start[0], end[0], gap, row, tops[line.source.level + 1] - start[1])
            line.points = [start, end]
            line.at = (x - width_of(line.label) / 2, tops[line.source.level + 1] + gap.y(1, row))
        else:
            x = channels[id(line)]
            gap = gaps[line.source.level + 1]
            below = tops[line.source.level + 1] + gap.y(0, gap.leaving[id(line)])
            gap = gaps[line.target.level]
            above = tops[line.target.level] + gap.y(2, gap.entering[id(line)])
            way = [(start[0], below), (x, below), (x, above), (end[0], above)]
            line.points = [start, *way, end]
            line.at = (start[0] + 5, below - 3)
    right = max([wide, *channels.values(), *(line.at[0] + width_of(line.label) for line in lines)])
    return right + MARGIN, tops[-1] + gaps[-1].height


def _right_end(rows: list[list[Node]], lines: list[Line]) -> float:
    """Where the widest level ends."""
    ends = [node.x + node.width / 2 for row in rows for node in row]
    ends += [
        n.x + n.width / 2 + LOOP + width_of(x.label) for x in lines if x.loops for n in [x.source]
    ]
    return max(ends)


def _ports(lines: list[Line], out: bool) -> dict[int, float]:
    """Where each line meets its node: side by side, in the order of the other ends."""
    of: dict[int, list[Line]] = defaultdict(list)
    for line in lines:
        if not line.loops:
            of[id(line.source if out else line.target)].append(line)
    ports = {id(line): 0.0 for line in lines}
    for members in of.values():
        members.sort(key=lambda x: (not x.falls, (x.target if out else x.source).x))
        node = members[0].source if out else members[0].target
        room = node.width - 2 * _PAD
        for place, line in enumerate(members):
            ports[id(line)] = node.x + room * ((place + 0.5) / len(members) - 0.5)
    return ports


def _channels(around: list[Line], left: float) -> dict[int, float]:
    """The x of each line that goes around, in as few channels as they need."""
    spans = [sorted((line.source.level + 0.5, line.target.level - 0.5)) for line in around]
    order = sorted(range(len(around)), key=lambda i: spans[i])
    given = lanes((spans[i][0], spans[i][1]) for i in order)
    found = {id(around[i]): left + lane * _CHANNEL for i, lane in zip(order, given, strict=True)}
    return found


def _gap(
    level: int,
    lines: list[Line],
    around: list[Line],
    out: dict[int, float],
    into: dict[int, float],
    channels: dict[int, float],
    tallest: float,
) -> _Gap:
    """The gap below a level whose tallest node is given; -1 is the one above the first."""
    leaving = _level_rows([x for x in around if x.source.level == level], out, channels)
    entering = _level_rows([x for x in around if x.target.level == level + 1], into, channels)
    falling = [line for line in lines if line.falls and line.source.level == level]
    sizes = (_size(leaving), _size(entering))
    for rows in range(1 if falling else 0, _MOST_ROWS):
        gap = _Gap(leaving, {}, entering, (sizes[0], rows, sizes[1]))
        labels = _labels(falling, gap, out, into, tallest)
        if labels is not None or rows == _MOST_ROWS - 1:
            placed = labels or {id(line): i % _MOST_ROWS for i, line in enumerate(falling)}
            return _Gap(leaving, placed, entering, gap.rows)
    raise AssertionError(level)


def _level_rows(
    members: list[Line], ports: dict[int, float], channels: dict[int, float]
) -> dict[int, int]:
    """Rows for the level parts of lines; what goes furthest to the left is furthest from nodes."""
    members = sorted(members, key=lambda line: ports[id(line)])
    given = lanes((ports[id(line)], channels[id(line)]) for line in members)
    return {id(line): row for line, row in zip(members, given, strict=True)}


def _size(rows: dict[int, int]) -> int:
    return max(rows.values(), default=-1) + 1


def _middle_of(left: float, right: float, gap: _Gap, row: int, above: float) -> float:
    """Where a line crosses a row of labels; it begins `above` the gap, and ends with it."""
    return left + (right - left) * (gap.y(1, row) - 4 + above) / (gap.height + above)


def _labels(
    falling: list[Line],
    gap: _Gap,
    out: dict[int, float],
    into: dict[int, float],
    tallest: float,
) -> dict[int, int] | None:
    """A row for the label of each line, so that none covers another; None when there is none."""
    taken: list[list[tuple[float, float]]] = [[] for _ in range(gap.rows[1])]
    found: dict[int, int] = {}
    for line in sorted(falling, key=lambda x: out[id(x)] + into[id(x)]):
        half = width_of(line.label) / 2 + 4
        for row in _from_middle(gap.rows[1]):
            above = tallest - line.source.height
            x = _middle_of(out[id(line)], into[id(line)], gap, row, above)
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


def _loop(line: Line) -> None:
    node = line.source
    x, y = node.x + node.width / 2, node.top + node.height / 2
    line.points = [(x, y - 5), (x + 18, y - 5), (x + 18, y + 5), (x, y + 5)]
    line.at = (x + 23, y + 4)
