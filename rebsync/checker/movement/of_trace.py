"""The movement of the robots of a model in one of its runs: a function of the run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from rebsync.checker.movement.courses import Deed, deeds
from rebsync.checker.movement.drive import legs, poses
from rebsync.checker.movement.encounters import encounters, nearest
from rebsync.checker.movement.ways import Movement, Pose, Way
from rebsync.checker.trace import ShownRebec, Trace
from rebsync.config import Config
from rebsync.model import Annotation, walk
from rebsync.static import Analysis
from rebsync.static.cells import CellOf
from rebsync.static.inferred_cells import cell_of
from rebsync.static.symbols import ClassInfo


def movement_of(
    trace: Trace, analysis: Analysis, config: Config, cells: Mapping[str, CellOf]
) -> Movement | None:
    """Where robots are when, of a run of a model; None where the model has no `@Move`.

    `cells` are what the settings say of robots and classes by their names.
    """
    if not has_moves(analysis):
        return None
    done = deeds(trace, analysis)
    if done is None:
        return None
    robots = [r for r in trace.steps[0].rebecs if is_robot(analysis, r.name, done)]
    ways = [_way(robot, analysis, config, cells, done) for robot in robots]
    until = float(max(step.until for step in trace.steps))
    return movement_along(ways, until)


def movement_along(ways: Iterable[Way], until: float, begin: float = 0.0) -> Movement:
    """The movement of robots along ways, with where they meet; a run from `begin` to `until`."""
    every = tuple(ways)
    end = max([until, *(way.poses[-1].time for way in every)])
    meet, near = encounters(every, end, begin), nearest(every, end, begin)
    return Movement(every, until, end, meet, near, begin)


def has_moves(analysis: Analysis) -> bool:
    """Whether any robot of a model moves by `@Move`."""
    return any(isinstance(n, Annotation) and n.name == "Move" for n in walk(analysis.model))


def is_robot(analysis: Analysis, rebec: str, done: Iterable[Deed]) -> bool:
    """Whether a rebec is to be drawn: its class is a `@Robot`, or it moves."""
    info = class_of(analysis, rebec)
    lineage = (analysis.classes[name] for name in info.lineage)
    marked = any(each.annotated("Robot") for each in lineage)
    return marked or any(d.rebec == rebec and d.kind == "move" for d in done)


def class_of(analysis: Analysis, rebec: str) -> ClassInfo:
    """The class of an instance."""
    main = analysis.model.main
    assert main is not None
    return next(analysis.classes[r.type.name] for r in main.rebecs if r.name == rebec)


def cell_in(analysis: Analysis, rebec: str, cells: Mapping[str, CellOf]) -> CellOf:
    """What gives the cell of a robot: the settings for it, for its class, or its bodies."""
    info = class_of(analysis, rebec)
    return cells.get(rebec) or cells.get(info.name) or cell_of(info)


def _way(
    robot: ShownRebec,
    analysis: Analysis,
    config: Config,
    cells: Mapping[str, CellOf],
    done: Iterable[Deed],
) -> Way:
    start = cell_in(analysis, robot.name, cells).at(dict(robot.variables), analysis.env)
    driven, lost = legs(deed for deed in done if deed.rebec == robot.name)
    first = Pose(0.0, start.x, start.y, config.heading)
    info = class_of(analysis, robot.name)
    return Way(robot.name, info.name, start, poses(driven, first, config.drive), lost)
