"""The movement of robots as JSON: for other programs, and for the drawing in a page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, TypeAlias

from rebsync.checker.movement.ways import Encounter, Movement, Pose, Way
from rebsync.checker.trace import ShownRebec, Trace
from rebsync.records import dataclass

Json: TypeAlias = dict[str, Any]

_DIGITS = 6  # behind the point: a millionth of a cell


@dataclass(frozen=True, slots=True)
class Frame:
    """What a step leaves: its number, when it happens, and the rebecs afterwards."""

    number: int
    time: float
    rebecs: tuple[ShownRebec, ...]


def frames(trace: Trace) -> tuple[Frame, ...]:
    """The steps of a run of a model."""
    return tuple(Frame(step.number, step.time, step.rebecs) for step in trace.steps)


def movement_json(movement: Movement | None) -> Json | None:
    """The ways of the robots, and where they meet; in cells and units of model time."""
    if movement is None:
        return None
    return {
        "until": short(movement.until),
        "end": short(movement.end),
        "robots": [_way(way) for way in movement.ways],
        "encounters": [_encounter(each) for each in movement.encounters],
        "nearest": _encounter(movement.nearest) if movement.nearest is not None else None,
    }


def _way(way: Way) -> Json:
    start = way.start
    return {
        "name": way.robot,
        "class": way.class_name,
        "start": {"x": short(start.x), "y": short(start.y), "from": list(start.told_by)},
        "path": [
            {"time": time, "x": x, "y": y, "heading": heading}
            for time, x, y, heading in map(_numbers, way.poses)
        ],
        "lost": None if way.lost is None else short(way.lost),
    }


def _encounter(each: Encounter) -> Json:
    return {
        "robots": list(each.robots),
        "from": short(each.start),
        "until": short(each.end),
        "time": short(each.time),
        "distance": short(each.distance),
    }


def scene(movement: Movement, steps: Sequence[Frame]) -> Json:
    """What the drawing plays: ways as lists of numbers, and the values that steps change."""
    return {
        "robots": [
            {
                "name": way.robot,
                "path": [_numbers(pose) for pose in way.poses],
                "lost": None if way.lost is None else short(way.lost),
            }
            for way in movement.ways
        ],
        "begin": short(movement.begin),
        "steps": [frame.number for frame in steps],
        "changes": list(_changes(movement, steps)),
        "encounters": [_encounter(each) for each in movement.encounters],
    }


def _changes(movement: Movement, steps: Sequence[Frame]) -> Iterator[list[int | str]]:
    """Position of the step, of the robot and of its variable, and the new value; first all."""
    places = {way.robot: number for number, way in enumerate(movement.ways)}
    before: dict[tuple[int, int], str] = {}
    for position, frame in enumerate(steps):
        for rebec in frame.rebecs:
            if rebec.name not in places:
                continue
            robot = places[rebec.name]
            for variable, (_, value) in enumerate(rebec.variables):
                if before.get((robot, variable)) != value:
                    before[robot, variable] = value
                    yield [position, robot, variable, value]


def _numbers(pose: Pose) -> list[float]:
    return [short(pose.time), short(pose.x), short(pose.y), short(pose.heading)]


def short(value: float) -> float:
    """A number without the noise of its last bits; a whole one as such."""
    rounded = round(value, _DIGITS)
    return int(rounded) if rounded == int(rounded) else rounded
