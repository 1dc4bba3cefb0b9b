"""Where robots were in a recorded run: `cmd_vel` integrated, else their cells by their states."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import field, replace

from rebsync.checker.movement.of_trace import cell_in, has_moves, is_robot, movement_along
from rebsync.checker.movement.ways import Movement, Pose, Way
from rebsync.checker.show.movement_data import Frame
from rebsync.checker.trace import ShownRebec
from rebsync.conform.observable import Observable
from rebsync.conform.recording import Driven, Event, Recording, Served
from rebsync.records import dataclass
from rebsync.static import Analysis
from rebsync.static.cells import CellOf, Start

MOST = 4000  # poses of a robot: of a long run the last ones


@dataclass(frozen=True, slots=True)
class RecordedMovement:
    """The movement of a recorded run, and the steps that are shown with it."""

    movement: Movement
    frames: tuple[Frame, ...]


def recorded_movement(
    observable: Observable,
    analysis: Analysis,
    cells: Mapping[str, CellOf],
    recording: Recording,
    zero: float,
    shown: Sequence[tuple[int, Served]],
    until: float = math.inf,
) -> RecordedMovement | None:
    """How robots moved from the first of the steps that are `shown`, which have numbers.

    `zero` is time 0 of the recording's clock, `until` when on it to end. None where the model has
    no moves, or none was seen.
    """
    if not shown or not has_moves(analysis):
        return None
    rebecs = [r.name for r in observable.program.rebecs]
    robots = {
        number: _Robot(name, cell_in(analysis, name, cells), analysis, observable, number)
        for number, name in enumerate(rebecs)
        if is_robot(analysis, name, ())
    }
    settings = observable.package.settings
    for event in recording.events():
        robot = robots.get(_rebec(event))
        if robot is not None and event.stamp <= until:
            robot.see(event, (event.stamp - zero) / settings.time_unit)
    ways = [way for robot in robots.values() if (way := robot.way()) is not None]
    frames = [
        Frame(number, (served.stamp - zero) / settings.time_unit, (_rebec_of(observable, served),))
        for number, served in shown
    ]
    return _between(ways, sorted(frames, key=lambda frame: frame.time)) if ways else None


def _rebec(event: Event) -> int:
    return event.rebec if isinstance(event, (Driven, Served)) else -1


def _between(ways: list[Way], frames: list[Frame]) -> RecordedMovement:
    """The ways from the first step to the last one."""
    begin = frames[0].time
    kept = [
        replace(way, poses=(way.at(begin), *(pose for pose in way.poses if pose.time > begin)))
        for way in ways
    ]
    until = max([frames[-1].time, *(way.poses[-1].time for way in kept)])
    return RecordedMovement(movement_along(kept, until, begin), tuple(frames))


def _rebec_of(observable: Observable, served: Served) -> ShownRebec:
    name = observable.program.rebecs[served.rebec].name
    return ShownRebec(name, tuple(observable.shown(served.rebec, served.cells).items()), ())


@dataclass(slots=True, eq=False)
class _Robot:
    """A robot as it is seen in a recording."""

    name: str
    gives: CellOf
    analysis: Analysis
    observable: Observable
    number: int
    start: Start | None = None
    driven: list[Pose] = field(default_factory=list)
    told: list[Pose] = field(default_factory=list)
    velocity: Driven | None = None

    def see(self, event: Event, time: float) -> None:
        """A velocity, or a state after a body."""
        match event:
            case Served():
                self._state(event, time)
            case Driven():
                self._drive(event, time)
            case _:
                pass

    def _state(self, served: Served, time: float) -> None:
        cell = self.gives.at(self.observable.shown(served.rebec, served.cells), self.analysis.env)
        settings = self.observable.package.settings
        if self.start is None:
            self.start = cell
            self.told.append(Pose(time, cell.x, cell.y, settings.heading))
            return
        before = self.told[-1]
        if (cell.x, cell.y) != (before.x, before.y):
            began = max(before.time, time - (served.now - served.start))
            if began > before.time:
                self.told.append(replace(before, time=began))
        self.told.append(Pose(max(time, before.time), cell.x, cell.y, before.heading))
        _shorten(self.told)

    def _drive(self, driven: Driven, time: float) -> None:
        if self.start is None:  # it stands until the first body has ended
            return
        settings = self.observable.package.settings
        if not self.driven:
            at = self.told[0]
            self.driven.append(replace(at, time=min(at.time, time)))
        before, last = self.driven[-1], self.velocity
        self.velocity = driven
        seconds = max(time - before.time, 0.0) * settings.time_unit
        x = last.x * seconds / settings.cell_size if last is not None else 0.0
        y = last.y * seconds / settings.cell_size if last is not None else 0.0
        turn = last.turn * seconds if last is not None else 0.0
        middle = before.heading + turn / 2
        self.driven.append(
            Pose(
                max(time, before.time),
                before.x + x * math.cos(middle) - y * math.sin(middle),
                before.y + x * math.sin(middle) + y * math.cos(middle),
                before.heading + turn,
            )
        )
        _shorten(self.driven)

    def way(self) -> Way | None:
        """Where it was; by its velocities if any were recorded."""
        if self.start is None:
            return None
        info = self.observable.program.rebecs[self.number]
        poses = self.driven or self.told
        return Way(self.name, info.class_name, self.start, tuple(poses))


def _shorten(poses: list[Pose]) -> None:
    """Drops old poses, and the middle one of three in which a robot stands."""
    if len(poses) >= 3:
        a, b, c = poses[-3:]
        if all((p.x, p.y, p.heading) == (a.x, a.y, a.heading) for p in (b, c)):
            del poses[-2]
    if len(poses) > 2 * MOST:
        del poses[:-MOST]
