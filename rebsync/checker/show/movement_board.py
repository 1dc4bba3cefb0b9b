"""The ground on which robots move, as SVG: cells, ways, and the robots where they start."""

from __future__ import annotations

import math
from collections.abc import Iterator

from rebsync.checker.movement.ways import Movement, Way
from rebsync.checker.show.markup import Markup, element, joined, number
from rebsync.records import dataclass

COLOURS = 8  # of robots, in the style of the page; then from the first again
_WIDE, _HIGH = 560, 230  # pixels, for a cell as large as fits
_MOST = 64.0
_MARGIN = 26.0
_LABELS = 26.0  # pixels between two coordinates at least
_STEPS = (1, 2, 5)
_SLIP = 0.25  # cells by which a recorded robot may be beside its cell


@dataclass(frozen=True, slots=True)
class Board:
    """The cells that a drawing shows, `cell` pixels wide; Y goes up."""

    left: int
    bottom: int
    right: int
    top: int
    cell: float

    @classmethod
    def of(cls, movement: Movement) -> Board:
        """All cells that a robot comes to."""
        poses = [pose for way in movement.ways for pose in way.poses]
        left, right = _whole([pose.x for pose in poses])
        bottom, top = _whole([pose.y for pose in poses])
        fits = min(_WIDE / (right - left + 1), _HIGH / (top - bottom + 1))
        return cls(left, bottom, right, top, min(fits, _MOST))

    @property
    def width(self) -> float:
        return (self.right - self.left + 1) * self.cell + 2 * _MARGIN

    @property
    def height(self) -> float:
        return (self.top - self.bottom + 1) * self.cell + 2 * _MARGIN

    def x(self, x: float) -> float:
        """Where a coordinate is in the drawing, in pixels."""
        return _MARGIN + (x - self.left + 0.5) * self.cell

    def y(self, y: float) -> float:
        """Where a coordinate is in the drawing, in pixels."""
        return _MARGIN + (self.top - y + 0.5) * self.cell

    @property
    def radius(self) -> float:
        """Of a robot, which is to be seen however small its cell is."""
        return max(self.cell * 0.3, 6.0)

    @property
    def below(self) -> float:
        """From the middle of a robot to the foot of its name."""
        return self.radius + 12


def _whole(values: list[float]) -> tuple[int, int]:
    """The cells around some coordinates."""
    return math.floor(min(values) + _SLIP), math.ceil(max(values) - _SLIP)


def drawing(movement: Movement, name: str) -> Markup:
    """The ground and the robots; `name` is unique in the page. A script moves the robots."""
    board = Board.of(movement)
    names = ", ".join(way.robot for way in movement.ways)
    title = f"{name}-title"
    return element(
        "svg",
        joined(
            element("title", f"The robots on their cells: {names}", id=title),
            *_grid(board),
            element("rect", class_="clash", width=board.cell, height=board.cell, hidden=True),
            *(_path(way, place, board) for place, way in enumerate(movement.ways)),
            *(_robot(way, place, board) for place, way in enumerate(movement.ways)),
            *(_name(way, place, board) for place, way in enumerate(movement.ways)),
        ),
        class_="board",
        viewBox=f"0 0 {number(board.width)} {number(board.height)}",
        width=board.width,
        height=board.height,
        role="img",
        aria_labelledby=title,
        data_cell=repr(board.cell),
        data_x=repr(board.x(0)),
        data_y=repr(board.y(0)),
        data_below=repr(board.below),
    )


def _grid(board: Board) -> Iterator[Markup]:
    start, end = _MARGIN, board.width - _MARGIN
    floor = board.height - _MARGIN
    yield element(
        "rect", class_="ground", x=start, y=start, width=end - start, height=floor - start
    )
    every = _spacing(board.cell)
    for x in range(board.left, board.right + 1):
        if x % every:
            continue
        at = board.x(x) - board.cell / 2
        yield element("line", class_="edge", x1=at, y1=start, x2=at, y2=floor)
        yield element("text", str(x), class_="axis", x=board.x(x), y=floor + 16)
    for y in range(board.bottom, board.top + 1):
        if y % every:
            continue
        at = board.y(y) + board.cell / 2
        yield element("line", class_="edge", x1=start, y1=at, x2=end, y2=at)
        yield element("text", str(y), class_="axis", x=start - 13, y=board.y(y) + 4)


def _spacing(cell: float) -> int:
    """How many cells are between two lines, so that their numbers can be read."""
    power = 1
    while True:
        for step in _STEPS:
            if step * power * cell >= _LABELS:
                return step * power
        power *= 10


def _path(way: Way, place: int, board: Board) -> Markup:
    places = dict.fromkeys((board.x(pose.x), board.y(pose.y)) for pose in way.poses)
    points = " ".join(f"{number(x)},{number(y)}" for x, y in places)
    kind = f"path r{place % COLOURS}"
    return element("polyline", class_=kind, points=points)


def _robot(way: Way, place: int, board: Board) -> Markup:
    """A robot as a disc with a nose, where it starts."""
    size, start = board.radius, way.poses[0]
    nose = f"M{number(size * 0.8)},{number(-size * 0.6)}L{number(size * 1.5)},0"
    nose += f"L{number(size * 0.8)},{number(size * 0.6)}z"
    turned = -math.degrees(start.heading)
    return element(
        "g",
        element("title", _about(way)),
        element(
            "g",
            element("path", class_="nose", d=nose),
            element("circle", class_="disc", r=size),
            class_="body",
            transform=f"rotate({turned:.2f})",
        ),
        class_=f"robot r{place % COLOURS}",
        data_robot=str(place),
        transform=f"translate({board.x(start.x):.2f} {board.y(start.y):.2f})",
    )


def _name(way: Way, place: int, board: Board) -> Markup:
    """The name of a robot, below it; in front of all robots."""
    start = way.poses[0]
    return element(
        "text",
        way.robot,
        class_=f"name r{place % COLOURS}",
        data_name=str(place),
        x=board.x(start.x),
        y=board.y(start.y) + board.below,
    )


def _about(way: Way) -> str:
    told = [text for text in way.start.told_by if text is not None]
    said = (
        f"its cell at the start is ({', '.join(told)})"
        if way.start.known
        else ("its cell at the start is not known: see [cells] in rebsync.toml")
    )
    return f"{way.robot}, a {way.class_name}: {said}"
