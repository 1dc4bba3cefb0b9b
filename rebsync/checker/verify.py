"""Verification: one search, then everything that it says about the model and its properties."""

from __future__ import annotations

import time
from dataclasses import replace

from rebsync.checker.choosing import semantics_for
from rebsync.checker.cluster.scope import check_scope
from rebsync.checker.conclusion import Conclusion
from rebsync.checker.endless import endless_reason
from rebsync.checker.exploration import Exploration, Faults, Progress, Report
from rebsync.checker.formulas import NamedFormula
from rebsync.checker.incomplete import limited
from rebsync.checker.invariants import asserted, invariants_of
from rebsync.checker.look import Stopped
from rebsync.checker.lowering import lower
from rebsync.checker.measures import unmeasured
from rebsync.checker.memory import peak_memory, used_memory
from rebsync.checker.orbits import Orbits
from rebsync.checker.problem import Options, Problem
from rebsync.checker.program import Program
from rebsync.checker.reducing import Reducing
from rebsync.checker.result import Coverage, Result, Verdict
from rebsync.checker.telling import Teller
from rebsync.checker.views import view_of
from rebsync.checker.watch import Watch


def verify(problem: Problem, options: Options, report: Report | None = None) -> Result:
    """Everything that can go wrong in a model, with a shortest run to each."""
    started = time.perf_counter()
    look = Watch(options.limits, report, started, Progress(0, 0, 0, 0, 0.0, 0, "lowering"))
    try:
        program, formulas = lower(
            problem.analysis,
            problem.properties,
            look,
            measures=problem.measures,
            between=problem.between,
        )
        return _searched(problem, options, report, started, program, formulas)
    except Stopped as stopped:  # before there was anything to search
        return _nothing_found(problem, options, str(stopped), time.perf_counter() - started)


def _searched(
    problem: Problem,
    options: Options,
    report: Report | None,
    started: float,
    program: Program,
    formulas: tuple[NamedFormula, ...],
) -> Result:
    """What a search finds. Raises Stopped when a bound is reached before it has begun."""
    if options.cluster:
        check_scope(problem, options)
    assertions = formulas[: len(problem.properties.assertions)]
    invariants = invariants_of(program, assertions, formulas)
    semantics = options.semantics or semantics_for(program, problem)
    faults = Faults(frozenset(asserted(assertions)), "deadlock" not in options.allowed)
    options = options.bounded(started, faults)
    asks_more = len(assertions) < len(formulas) or problem.is_measured
    search, exploration, persistent, symmetry = Reducing(
        program, semantics, invariants, problem, options, report, asks_more
    ).searched()
    if exploration.cut:
        reason = endless_reason(program, exploration.cut, problem.source)
        exploration = replace(exploration, reason=reason)
    view = view_of(program, exploration.semantics, persistent)
    view.limit(options.limits.instructions)
    orbits = Orbits(exploration.semantics, symmetry) if symmetry.order > 1 else None
    teller = Teller(view, problem.source, orbits)
    watch = _watch(exploration, options, report, started)
    answer = Conclusion(problem, options, program, formulas, search, exploration, teller, watch)
    answer.collect()
    return limited(problem, answer.result(time.perf_counter() - started), teller)


def _nothing_found(problem: Problem, options: Options, reason: str, seconds: float) -> Result:
    """The answer when a bound was reached before the first state."""
    names = [entry.name for entry in problem.properties.all]
    known: tuple[tuple[str, Verdict], ...] = tuple((name, "undetermined") for name in names)
    memory, semantics = peak_memory(), options.semantics or "tts"
    return Result(
        "undetermined", reason, (), known, (), Coverage((), (), ()), 0, 0, 0, semantics,
        "interpreted", seconds, 0.0, 0.0, memory, unmeasured(problem.measures),
    )  # fmt: skip


def _watch(found: Exploration, options: Options, report: Report | None, started: float) -> Watch:
    """What holds the rest of the work to the bounds of the search."""
    now = time.perf_counter() - started
    figures = Progress(found.states, found.transitions, found.depth, 0, now, used_memory())
    return Watch(options.limits, report, started, figures)
