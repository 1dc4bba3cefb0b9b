"""What the pages and objects of runs show besides the steps, with the settings beside a model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rebsync.checker.movement.ways import Moving
    from rebsync.checker.problem import Problem
    from rebsync.checker.show.page_run import RunDetails
    from rebsync.checker.steps import Semantics
    from rebsync.checker.telling import Teller
    from rebsync.cli.serving import Live


def moving_in(problem: Problem) -> Moving:
    """What gives the movement in a run; RebsyncError when `[cells]` of the settings is wrong."""
    from rebsync.checker.movement import movement_of
    from rebsync.config import settings_beside
    from rebsync.grammars.cells import parse_cells

    settings, config = settings_beside(problem.source.path)
    cells = parse_cells(settings, config, problem.analysis)
    return lambda trace: movement_of(trace, problem.analysis, config, cells)


def details_in(problem: Problem, semantics: Semantics) -> RunDetails:
    """What a page shows of the runs of a view."""
    return _details(problem, _teller(problem, semantics))


def live_in(problem: Problem, semantics: Semantics, page: Callable[[RunDetails], str]) -> Live:
    """What is served of a page, which is made from what it shows of the runs of a view."""
    from rebsync.checker.branching import NoSuchStep, run_along
    from rebsync.checker.show.page_run import followed_run
    from rebsync.cli.serving import Live, Refused

    teller = _teller(problem, semantics)
    details = _details(problem, teller)

    def follow(ordinals: tuple[int, ...], by_chance: int) -> str:
        try:
            return followed_run(run_along(teller, ordinals, by_chance), details)
        except NoSuchStep as missing:
            raise Refused(f"step {missing.number} cannot be made: {missing}") from None

    try:
        start = run_along(teller, (0,))
    except NoSuchStep:
        start = None
    return Live(lambda address: page(replace(details, live=address, start=start)), follow)


def _details(problem: Problem, teller: Teller) -> RunDetails:
    from rebsync.checker.branching import branchings
    from rebsync.checker.falsified import falsified_in
    from rebsync.checker.show.page_run import RunDetails

    return RunDetails(
        moving_in(problem),
        lambda trace: branchings(teller, trace),
        falsified_in(problem, teller.view.semantics),
    )


def _teller(problem: Problem, semantics: Semantics) -> Teller:
    """What makes and tells the steps of a model in a view, all of them."""
    from rebsync.checker.lowering import lower
    from rebsync.checker.telling import Teller
    from rebsync.checker.views import view_of

    program, _ = lower(problem.analysis, problem.properties)
    return Teller(view_of(program, semantics), problem.source)
