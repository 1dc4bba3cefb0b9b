"""Where everything in a message sequence chart goes, in pixels.

Columns are rebecs: on the left of its lifeline a rebec has lanes in which messages wait, on the
right its texts. Rows are steps. A message leaves its sender, level when it arrives at once and
falling when it is under way for some time, reaches a lane of its receiver and goes down in it
until it is taken.
"""

from __future__ import annotations

from collections import defaultdict

from rebsync.checker.show.chart_rows import LINE, Row, row_of, width_of
from rebsync.checker.show.flights import Flight, flights, lanes
from rebsync.checker.trace import Trace
from rebsync.records import dataclass

GUTTER = 92.0  # numbers of steps, and times
HEAD = 38.0
BOX = 5.0  # half the width of a body's box
TEXT = 11.0  # from the lifeline to its texts
_LANE = 8.0
_FIRST_LANE = 18.0
_BAND = 12.0  # the space above a new time
_MARGIN = 14.0
_LEAST_WIDTH = 420.0
_STUB = 16.0


@dataclass(frozen=True, slots=True)
class Placed:
    """A row and where it begins."""

    row: Row
    top: float

    @property
    def bottom(self) -> float:
        return self.top + self.row.height


@dataclass(frozen=True, slots=True)
class Way:
    """The line of a message: `path` while it is under way, then down a lane until `end`.

    `taken` is None when it ends waiting; a message that is still under way has no `lane`.
    """

    flight: Flight
    path: tuple[tuple[float, float], ...]
    lane: tuple[float, float, float] | None  # x, from, until
    head: tuple[float, float] | None


@dataclass(frozen=True, slots=True)
class Chart:
    """The geometry of a chart."""

    names: tuple[str, ...]
    lifelines: tuple[float, ...]
    rows: tuple[Placed, ...]
    bands: tuple[tuple[int, float], ...]  # time, where it begins
    ways: tuple[Way, ...]
    busy: tuple[tuple[int, float, float], ...]  # column, from, until
    width: float
    height: float


def chart_of(trace: Trace) -> Chart:
    """Lays out a run."""
    names = tuple(rebec.name for rebec in trace.steps[0].rebecs)
    rows, bands, bottom = _rows(trace, names)
    routes = [_route(flight, names, rows, bands, bottom) for flight in flights(trace)]
    given = _lanes(routes)
    lifelines, width = _columns(names, rows, given, routes)
    ways = tuple(_way(r, lane, lifelines) for r, lane in zip(routes, given, strict=True))
    busy = _busy(trace, rows, bands, bottom)
    return Chart(names, lifelines, rows, bands, ways, busy, width, bottom + _MARGIN)


Bands = tuple[tuple[int, float], ...]


def _rows(trace: Trace, names: tuple[str, ...]) -> tuple[tuple[Placed, ...], Bands, float]:
    """Rows below each other, with a new band wherever time has passed; and their end."""
    rows: list[Placed] = []
    bands: list[tuple[int, float]] = []
    y = HEAD
    for step in trace.steps:
        if not bands or step.time != bands[-1][0]:
            y += _BAND
            bands.append((step.time, y - 4))
        rows.append(Placed(row_of(step, names), y))
        y += rows[-1].row.height
    last = trace.steps[-1]
    if last.until != last.time:
        y += _BAND
        bands.append((last.until, y - 4))
        y += LINE
    return tuple(rows), tuple(bands), y + 4


# --- messages ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Route:
    """The heights of a message's way; `arrives` is None when that is beyond the chart."""

    flight: Flight
    sender: int
    receiver: int
    leaves: float
    arrives: float | None
    until: float
    taken: bool

    @property
    def lane_start(self) -> float:
        """A message to oneself goes to its lane at once."""
        if self.arrives is None or self.sender == self.receiver:
            return self.leaves
        return self.arrives


def _route(
    flight: Flight,
    names: tuple[str, ...],
    rows: tuple[Placed, ...],
    bands: Bands,
    bottom: float,
) -> _Route:
    start = rows[flight.sent]
    leaves = start.top + start.row.leaving[flight.place]
    until = bottom
    if flight.taken is not None:
        until = rows[flight.taken].top + LINE / 2 + 5
    arrives: float | None = leaves
    if flight.message.arrival > start.row.step.time:
        arrives = _height_of(flight.message.arrival, bands, leaves)
        if arrives is None and flight.taken is not None:
            arrives = until
    sender, receiver = (names.index(n) for n in (flight.message.sender, flight.message.receiver))
    return _Route(flight, sender, receiver, leaves, arrives, until, flight.taken is not None)


def _height_of(time: int, bands: Bands, below: float) -> float | None:
    """Where a time begins: at the first band that is not before it."""
    return next((max(y + 3, below) for at, y in bands if at >= time), None)


def _lanes(routes: list[_Route]) -> list[int]:
    """The lane of each message at its receiver."""
    given = [0] * len(routes)
    of: dict[int, list[int]] = defaultdict(list)
    for number, route in enumerate(routes):
        if route.arrives is not None:
            of[route.receiver].append(number)
    for numbers in of.values():
        numbers.sort(key=lambda n: routes[n].lane_start)
        spans = [(routes[n].lane_start, routes[n].until) for n in numbers]
        for number, lane in zip(numbers, lanes(spans), strict=True):
            given[number] = lane
    return given


def _way(route: _Route, lane: int, lifelines: tuple[float, ...]) -> Way:
    here, there = lifelines[route.sender], lifelines[route.receiver]
    side = 1 if route.receiver > route.sender else -1
    start = (here + side * BOX, route.leaves)
    if route.arrives is None:
        return Way(route.flight, (start, (start[0] + side * _STUB, route.leaves)), None, None)
    x = there - _FIRST_LANE - lane * _LANE
    arrival = (x, min(route.arrives, route.until))
    path = (start, (x, route.leaves), arrival) if here == there else (start, arrival)
    head = (there - BOX, route.until) if route.taken else None
    return Way(route.flight, path, (x, arrival[1], route.until), head)


# --- columns -----------------------------------------------------------------------------------


def _columns(
    names: tuple[str, ...], rows: tuple[Placed, ...], given: list[int], routes: list[_Route]
) -> tuple[tuple[float, ...], float]:
    """The lifelines, so that lanes, texts and names have room; and the whole width."""
    left = [width_of(name) / 2 + 12 for name in names]
    right = list(left)
    for lane, route in zip(given, routes, strict=True):
        room = _FIRST_LANE + (lane + 1) * _LANE
        left[route.receiver] = max(left[route.receiver], room)
    for placed in rows:
        for text in placed.row.texts:
            if text.column >= 0:
                room = TEXT + width_of(text.text) + 10
                right[text.column] = max(right[text.column], room)
    lifelines = []
    x = GUTTER
    for before, after in zip(left, right, strict=True):
        lifelines.append(x + before)
        x += before + after
    return tuple(lifelines), max(x + 2 * _MARGIN, _LEAST_WIDTH)


def _busy(
    trace: Trace, rows: tuple[Placed, ...], bands: Bands, bottom: float
) -> tuple[tuple[int, float, float], ...]:
    """Where rebecs are busy between their steps."""
    found: list[tuple[int, float, float]] = []
    for column in range(len(trace.steps[0].rebecs)):
        own = [
            n for n, p in enumerate(rows) if p.row.column == column or p.row.step.kind == "start"
        ]
        for number, following in zip(own, [*own[1:], None], strict=False):  # it may have no step
            until = trace.steps[number].rebecs[column].busy_until
            if until is None or trace.steps[number].failure is not None:
                continue
            start = rows[number].bottom
            end = bottom if following is None else rows[following].top
            idle = _height_of(until, bands, start)
            if following is None or trace.steps[following].kind != "resume":
                end = min(end, idle) if idle is not None else end
            if end > start:
                found.append((column, start, end))
    return tuple(found)
