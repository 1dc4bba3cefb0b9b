"""The ways of robots in the plane: where they were when, how near they came, and a picture."""

from __future__ import annotations

import math
import os
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#5b5b5b")
_CELL = 80
_STEP = 0.02


@dataclass(frozen=True, slots=True)
class Way:
    """The way of a robot, in cells: at each of the times the place where it was."""

    robot: str
    times: tuple[float, ...]
    places: tuple[tuple[float, float], ...]

    def at(self, time: float) -> tuple[float, float]:
        """Where the robot is: on the straight line between the places before and after."""
        after = bisect_right(self.times, time)
        if after == 0 or after == len(self.times):
            return self.places[min(after, len(self.places) - 1)]
        (x0, y0), (x1, y1) = self.places[after - 1], self.places[after]
        start, end = self.times[after - 1], self.times[after]
        share = (time - start) / (end - start)
        return x0 + (x1 - x0) * share, y0 + (y1 - y0) * share


@dataclass(frozen=True, slots=True)
class Meeting:
    """The moment when two robots are nearest to each other."""

    distance: float
    time: float
    robots: tuple[str, str]
    places: tuple[tuple[float, float], tuple[float, float]]


def nearest(ways: Sequence[Way]) -> Meeting:
    """The closest that any two of the robots come."""
    return min(_meetings(ways), key=lambda meeting: meeting.distance)


def _meetings(ways: Sequence[Way]) -> Iterator[Meeting]:
    end = max(way.times[-1] for way in ways)
    for one, other in combinations(ways, 2):
        for tick in range(math.ceil(end / _STEP) + 1):
            time = tick * _STEP
            places = one.at(time), other.at(time)
            yield Meeting(math.dist(*places), time, (one.robot, other.robot), places)


def write_paths(name: str, ways: Sequence[Way], default: Path) -> Path:
    """Draw the ways to NAME.svg in the directory that REBSYNC_PATHS_SVG names, or in `default`."""
    folder = Path(os.environ.get("REBSYNC_PATHS_SVG") or default)
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{name}.svg"
    file.write_text(draw(name, ways), encoding="utf-8")
    return file


def draw(name: str, ways: Sequence[Way]) -> str:
    """An SVG picture: cells, ways from ring to disc, and where two robots came nearest."""
    frame = _Frame.around(ways)
    colours = {way.robot: _COLOURS[i % len(_COLOURS)] for i, way in enumerate(ways)}
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {frame.width} {frame.height}" '
        f'width="{frame.width}" font-family="sans-serif" font-size="13">',
        f"<title>{name}</title>",
        '<rect width="100%" height="100%" fill="white"/>',
        *_grid(frame),
        *(line for way in ways for line in _way(way, frame, colours[way.robot])),
        *(_meeting(nearest(ways), frame, colours) if len(ways) > 1 else ()),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


@dataclass(frozen=True, slots=True)
class _Frame:
    """The cells that the picture shows; Y goes up."""

    left: int
    right: int
    bottom: int
    top: int

    @classmethod
    def around(cls, ways: Sequence[Way]) -> _Frame:
        xs = [x for way in ways for x, _ in way.places]
        ys = [y for way in ways for _, y in way.places]
        return cls(round(min(xs)), round(max(xs)), round(min(ys)), round(max(ys)))

    @property
    def width(self) -> int:
        return (self.right - self.left + 2) * _CELL

    @property
    def height(self) -> int:
        return (self.top - self.bottom + 2) * _CELL

    def point(self, x: float, y: float) -> tuple[float, float]:
        """Where a place of the plane is in the picture."""
        return (x - self.left + 1) * _CELL, (self.top - y + 1) * _CELL


def _grid(frame: _Frame) -> Iterator[str]:
    for x in range(frame.left, frame.right + 1):
        for y in range(frame.bottom, frame.top + 1):
            px, py = frame.point(x, y)
            yield (
                f'<rect x="{px - _CELL / 2:g}" y="{py - _CELL / 2:g}" width="{_CELL}" '
                f'height="{_CELL}" fill="none" stroke="#ddd"/>'
            )
            yield f'<text x="{px - 36:g}" y="{py + 36:g}" fill="#aaa">{x}, {y}</text>'


def _way(way: Way, frame: _Frame, colour: str) -> Iterator[str]:
    points = [frame.point(*place) for place in way.places]
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    (x0, y0), (x1, y1) = points[0], points[-1]
    yield f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="3"/>'
    yield f'<circle cx="{x0:.1f}" cy="{y0:.1f}" r="9" fill="white" stroke="{colour}"/>'
    yield f'<circle cx="{x1:.1f}" cy="{y1:.1f}" r="7" fill="{colour}"/>'
    yield f'<text x="{x0 + 12:.1f}" y="{y0 - 12:.1f}" fill="{colour}">{way.robot}</text>'


def _meeting(meeting: Meeting, frame: _Frame, colours: Mapping[str, str]) -> Iterator[str]:
    for robot, place in zip(meeting.robots, meeting.places, strict=True):
        x, y = frame.point(*place)
        yield (
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{_CELL / 4:g}" fill="{colours[robot]}" '
            'fill-opacity="0.3"/>'
        )
    facts = f"nearest: {meeting.distance:.2f} cells at {meeting.time:.2f} s"
    yield f'<text x="{_CELL / 4:g}" y="{_CELL / 4:g}">{facts}</text>'
