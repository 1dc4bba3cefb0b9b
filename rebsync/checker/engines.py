"""Which engine searches: the interpreter starts at once, the compiled one takes over."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from itertools import chain, repeat

from rebsync.checker.exploration import Exploration, Limits, Report, Search, Unavailable
from rebsync.checker.look import Stopped
from rebsync.checker.problem import Options
from rebsync.checker.program import Program
from rebsync.checker.reduction import PersistentSets
from rebsync.checker.search import PAUSED, Interpreted, Pause
from rebsync.checker.steps import Semantics
from rebsync.checker.symmetry import Symmetry

GLANCE = 0.05  # seconds after which it pays to look whether a model was compiled before
PATIENCE = 0.25  # seconds after which a search counts as large
HEAD_START = 1.0  # seconds that compiling has for itself: beside the interpreter it takes longer


def explore(
    program: Program,
    semantics: Semantics,
    invariants: tuple[int, ...],
    persistent: PersistentSets,
    symmetry: Symmetry,
    options: Options,
    report: Report | None = None,
) -> tuple[Search, Exploration]:
    """Searches with the engine that was asked for.

    Of `persistent` one rebec acts alone when it can; states are canonical under the `symmetry`.

    Raises Unavailable when the compiled engine was asked for and cannot be built, NoCluster when a
    cluster was asked for and cannot be had.
    """
    if options.cluster:
        from rebsync.checker.cluster.search import ClusterSearch

        searched = program, semantics, invariants, persistent
        shared = ClusterSearch(*searched, options.cluster, options.hash_compaction)
        return shared, shared.run(options.limits, report)
    if options.engine == "interpreted":
        interpreted = Interpreted(program, semantics, invariants, persistent, symmetry)
        return interpreted, interpreted.run(options.limits, report)
    if options.engine == "compiled":
        known = program, semantics, invariants, persistent, symmetry
        compiled = _compiled(*known, options, wanted=_in_time(options.limits))
        return compiled, compiled.run(options.limits, report)
    search = Interpreted(program, semantics, invariants, persistent, symmetry)
    return _auto(search, options, report)


def resume(
    search: Search, options: Options, report: Report | None = None
) -> tuple[Search, Exploration]:
    """Goes on with a search that its bound of states has ended."""
    if options.engine == "auto" and isinstance(search, Interpreted):
        return _auto(search, options, report)
    return search, search.run(options.limits, report)


def _compiled(
    program: Program,
    semantics: Semantics,
    invariants: tuple[int, ...],
    persistent: PersistentSets,
    symmetry: Symmetry,
    options: Options,
    build: bool = True,
    wanted: Callable[[], bool] = lambda: True,
) -> Search:
    from rebsync.checker.compiled import CompiledSearch

    return CompiledSearch(
        program,
        semantics,
        invariants,
        persistent,
        symmetry,
        hash_compaction=options.hash_compaction,
        threads=options.threads,
        build=build,
        wanted=wanted,
    )


def _in_time(limits: Limits) -> Callable[[], bool]:
    """Always true; raises Stopped when the bound of time is reached."""

    def wanted() -> bool:
        if limits.began is not None and (over := limits.out_of_time(0.0)):
            raise Stopped(over)
        return True

    return wanted


def _auto(
    search: Interpreted, options: Options, report: Report | None
) -> tuple[Search, Exploration]:
    """Interprets for a moment; then compiles, and goes on interpreting until that is done.

    What has been compiled before is taken as soon as a model is not tiny.
    """
    found = search.run(options.limits, report, _after(GLANCE))
    if found.reason != PAUSED:
        return search, found
    known = search.program, search.semantics, search.invariants, search.persistent, search.symmetry
    try:
        kept = _compiled(*known, options, build=False)
    except Unavailable:
        found = search.run(options.limits, report, _after(PATIENCE - GLANCE))
    else:
        return kept, kept.run(options.limits, report)
    if found.reason != PAUSED:
        return search, found
    return _compile_aside(search, options, report)


def _compile_aside(
    search: Interpreted, options: Options, report: Report | None
) -> tuple[Search, Exploration]:
    """Compiles; if that takes long the interpreter goes on. Who is done first does the rest."""
    from concurrent.futures import ThreadPoolExecutor, wait
    from threading import Event

    finished = Event()
    pauses = chain((HEAD_START,), repeat(0.0))
    known = search.program, search.semantics, search.invariants, search.persistent, search.symmetry
    with ThreadPoolExecutor(1) as pool:
        waiting = pool.submit(_compiled, *known, options, wanted=lambda: not finished.is_set())
        try:
            found = search.run(
                options.limits, report, lambda: bool(wait((waiting,), next(pauses)).done)
            )
        finally:
            finished.set()
        if found.reason != PAUSED:
            return search, found
        try:
            compiled = waiting.result()
        except Unavailable as unavailable:
            found = search.run(options.limits, report)
            note = f"the interpreter did all the work: {unavailable}"
            return search, replace(found, notes=(*found.notes, note))
    return compiled, compiled.run(options.limits, report)


def _after(seconds: float) -> Pause:
    end = time.monotonic() + seconds
    return lambda: time.monotonic() >= end
