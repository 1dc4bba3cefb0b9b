"""The movement of robots in runs of a model, with the settings beside it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rebsync.checker.movement.ways import Moving
    from rebsync.checker.problem import Problem


def moving_in(problem: Problem) -> Moving:
    """What gives the movement in a run; RebsyncError when `[cells]` of the settings is wrong."""
    from rebsync.checker.movement import movement_of
    from rebsync.config import settings_beside
    from rebsync.grammars.cells import parse_cells

    settings, config = settings_beside(problem.source.path)
    cells = parse_cells(settings, config, problem.analysis)
    return lambda trace: movement_of(trace, problem.analysis, config, cells)
