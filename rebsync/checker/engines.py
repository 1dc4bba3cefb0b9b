"""Which engine searches: the interpreter starts at once, the compiled one takes over."""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

from rebsync.checker.exploration import Exploration, Report, Search
from rebsync.checker.problem import Options
from rebsync.checker.program import Program
from rebsync.checker.search import PAUSED, Interpreted
from rebsync.checker.steps import Semantics


class Unavailable(Exception):
    """The compiled engine cannot be had here; the text says why."""


PATIENCE = 0.25  # seconds after which a search counts as large


def explore(
    program: Program,
    semantics: Semantics,
    invariants: tuple[int, ...],
    first: frozenset[int],
    options: Options,
    report: Report | None = None,
) -> tuple[Search, Exploration]:
    """Searches with the engine that was asked for.

    `first` are the rebecs of which one acts alone when it can.

    Raises Unavailable when the compiled engine was asked for and cannot be built.
    """
    if options.engine == "interpreted":
        interpreted = Interpreted(program, semantics, invariants, first)
        return interpreted, interpreted.run(options.limits, report)
    if options.engine == "compiled":
        compiled = _compiled(program, semantics, invariants, first, options)
        return compiled, compiled.run(options.limits, report)
    return _auto(program, semantics, invariants, first, options, report)


def _compiled(
    program: Program,
    semantics: Semantics,
    invariants: tuple[int, ...],
    first: frozenset[int],
    options: Options,
) -> Search:
    from rebsync.checker.compiled import CompiledSearch

    return CompiledSearch(
        program, semantics, invariants, first, hash_compaction=options.hash_compaction
    )


def _auto(
    program: Program,
    semantics: Semantics,
    invariants: tuple[int, ...],
    first: frozenset[int],
    options: Options,
    report: Report | None,
) -> tuple[Search, Exploration]:
    """Interprets for a moment; then compiles, and goes on interpreting until that is done."""
    search = Interpreted(program, semantics, invariants, first)
    large = time.monotonic() + PATIENCE
    found = search.run(options.limits, report, lambda: time.monotonic() >= large)
    if found.reason != PAUSED:
        return search, found
    with ThreadPoolExecutor(1) as pool:
        waiting = pool.submit(_compiled, program, semantics, invariants, first, options)
        found = search.run(options.limits, report, waiting.done)
        if found.reason != PAUSED:
            return search, found
        try:
            compiled = waiting.result()
        except Unavailable as unavailable:
            found = search.run(options.limits, report)
            note = f"the interpreter did all the work: {unavailable}"
            return search, replace(found, notes=(*found.notes, note))
    return compiled, compiled.run(options.limits, report)
