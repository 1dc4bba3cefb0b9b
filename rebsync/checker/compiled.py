"""Breadth-first search with the compiled engine: the model as C, and a search in C.

It gives the same numbers as the interpreter. The search is in templates/runtime.c, on the kernel of
templates/kernel.h.
"""

from __future__ import annotations

import ctypes
import time
from array import array
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import fields
from functools import partial
from typing import Any

from rebsync.checker import native
from rebsync.checker.asking import Answer, asking
from rebsync.checker.build import Unit, always, header, libraries
from rebsync.checker.compile_model import model_unit
from rebsync.checker.decoding import cause_of, covered, cut_of, risk_of_hashes
from rebsync.checker.endless import Cut, endless_reason
from rebsync.checker.exploration import (
    INSTRUCTIONS,
    Covered,
    Event,
    Exploration,
    Extremes,
    Limits,
    Progress,
    Report,
    Unavailable,
    bound_of_states,
    kinds_of,
)
from rebsync.checker.graph import Graph
from rebsync.checker.look import Look, unwatched
from rebsync.checker.memory import NO_MEMORY, used_memory
from rebsync.checker.program import Program
from rebsync.checker.reduction import PersistentSets
from rebsync.checker.search import FIRST
from rebsync.checker.steps import Semantics
from rebsync.checker.symmetry import Symmetry

_SLICE = 50_000_000  # nanoseconds between two looks at the bounds
_ENDLESS = 2**63 - 1  # states, or time: more than any search has


class CompiledSearch:
    """A search of a program made native. `invariants` are the predicates whose failure is an event.

    Of `persistent` one rebec acts alone when it can. With `hash_compaction` only 64 bits of each
    state are remembered; with a `symmetry` only canonical states are. With two `threads` one makes
    steps and the other stores states, if there are no `hash_compaction` and no bound of model time.

    Raises Unavailable when it cannot be built, or `build` is false and it has not been built
    before, or is not `wanted` any more meanwhile.
    """

    def __init__(
        self,
        program: Program,
        semantics: Semantics,
        invariants: tuple[int, ...] = (),
        persistent: PersistentSets = (),
        symmetry: Symmetry | None = None,
        *,
        hash_compaction: bool = False,
        threads: int = 1,
        build: bool = True,
        wanted: Callable[[], bool] = always,
    ) -> None:
        started = time.perf_counter()
        self.program = program
        self.semantics: Semantics = semantics
        self.invariants = invariants
        self.persistent = persistent
        self.symmetry = symmetry or Symmetry()
        self.hash_compaction = hash_compaction
        self._until: int | None = None
        self._instructions = INSTRUCTIONS
        self._cut: Cut | None = None
        self._spent = 0.0
        self._engine: int | None = None
        self._library, self._model = _libraries(program, build, wanted)
        self._engine = self._library.rebsync_new(
            ctypes.addressof(ctypes.c_char.in_dll(self._model, "rebsync_model")),
            native.SEMANTICS.index(semantics),
            hash_compaction,
            native.numbers(invariants),
            len(invariants),
            native.numbers(native.persistent_table(persistent, len(program.rebecs))),
            len(persistent),
        )
        if not self._engine or not self._reduce():
            raise Unavailable("there is no memory for a search, or no place for its temporary file")
        if threads > 1 and not hash_compaction:
            self._library.rebsync_two_threads(self._engine)
        self.build_seconds = time.perf_counter() - started

    def __del__(self) -> None:
        if self._engine:
            self._library.rebsync_free(self._engine)

    def _reduce(self) -> bool:
        """Tells C the symmetries; false without memory."""
        if self.symmetry.order == 1:
            return True
        tables = native.symmetry_tables(self.symmetry)
        return bool(self._library.rebsync_symmetry(self._engine, *tables))

    # --- searching

    def run(self, limits: Limits, report: Report | None = None) -> Exploration:
        """Searches on from where an earlier run stopped; `until` must be the same in all runs."""
        started = time.perf_counter() - self._spent
        if self._figures().initials and limits.until != self._until:
            raise ValueError("a search goes on with the bound of time that it began with")
        self._until, self._instructions = limits.until, limits.instructions
        self._cut = None
        try:
            reason = self._search(limits, report, started)
        except KeyboardInterrupt:
            reason = "it was interrupted"
        figures = self._figures()
        if reason is None and figures.dropped:
            reason = f"the bound of {limits.until} units of time was reached"
        self._spent = time.perf_counter() - started
        return Exploration(
            figures.states,
            figures.transitions,
            figures.depth,
            self._events(figures.events),
            self._covered(),
            self.semantics,
            "compiled",
            self._spent,
            self.build_seconds,
            used_memory(),
            reason,
            self._notes(figures.states),
            self._cut,
            self._measured(),
        )

    def _search(self, limits: Limits, report: Report | None, started: float) -> str | None:
        states = _ENDLESS if limits.states is None else min(limits.states, _ENDLESS)
        until = _ENDLESS if limits.until is None else min(limits.until, _ENDLESS)

        if limits.first:
            faults = native.numbers(sorted(limits.faults.predicates))
            count, deadlock = len(limits.faults.predicates), limits.faults.deadlock
            self._library.rebsync_stop_at_first(self._engine, faults, count, deadlock)

        def look() -> str | None:
            return self._look(limits, report, time.perf_counter() - started)

        while True:
            with self._asking(look) as answer:
                ended = self._library.rebsync_search(
                    self._engine, states, until, limits.instructions, _SLICE
                )
            match native.END[ended]:
                case "finished":
                    return None
                case "states":
                    return bound_of_states(states)
                case "endless":
                    self._cut = self._given_up(limits.instructions)
                    return endless_reason(self.program, self._cut)
                case "memory":
                    return NO_MEMORY
                case "violated":
                    return FIRST
                case "stopped":
                    return answer.reason or "it was stopped"
                case _:
                    if stop := look():
                        return stop

    def _asking(self, look: Callable[[], str | None] | Look) -> AbstractContextManager[Answer]:
        """Lets C ask `look` now and then what ends a step that takes long."""
        return asking(look, partial(self._library.rebsync_watch, self._engine))

    def _look(self, limits: Limits, report: Report | None, seconds: float) -> str | None:
        memory = used_memory()
        if report:
            now = self._figures()
            waiting = now.states - now.expanded
            found = kinds_of((e.cause for e in self._events(now.events)), limits.faults)
            known = now.states, now.transitions, now.level, waiting
            report(Progress(*known, seconds, memory, violations=found))
        return limits.out_of_time(seconds) or limits.out_of_memory(memory)

    # --- what was found

    def _figures(self) -> native.Figures:
        figures = native.Figures()
        self._library.rebsync_figures(self._engine, ctypes.byref(figures))
        return figures

    def _given_up(self, instructions: int) -> Cut:
        """The body that ended the search."""
        now = self._figures()
        return cut_of(now.cause, now.pc, now.outer, instructions)

    def _events(self, count: int) -> tuple[Event, ...]:
        found = self._library.rebsync_events(self._engine)
        return tuple(_event(self.program, found[i]) for i in range(count))

    def _measured(self) -> tuple[Extremes, ...]:
        found = self._library.rebsync_measured(self._engine)
        return tuple(
            Extremes(*(getattr(found[i], field.name) for field in fields(Extremes)))
            for i in range(len(self.program.measures))
        )

    def _covered(self) -> Covered:
        return covered(self.program, partial(self._library.rebsync_covered, self._engine))

    def _notes(self, states: int) -> tuple[str, ...]:
        return (risk_of_hashes(self.program, states),) if self.hash_compaction else ()

    # --- afterwards

    def path(self, state: int) -> tuple[int, ...]:
        """A shortest way to a state: the code of the initial state, then one for each step."""
        codes = []
        code = ctypes.c_int64()
        while state >= 0:
            with self._asking(unwatched):
                state = self._library.rebsync_before(self._engine, state, ctypes.byref(code))
            if state == native.NOT_FOUND:
                raise MemoryError
            codes.append(code.value)
        return tuple(reversed(codes))

    def graph(self, look: Look = unwatched) -> Graph:
        """The state space that was seen; steps to states that were not seen are left out.

        Fingerprints do not give it: with them, all of it is searched again.
        """
        figures = self._figures()
        if self.hash_compaction:
            exact = CompiledSearch(self.program, self.semantics, (), self.persistent, self.symmetry)
            stopped = figures.states if figures.expanded < figures.states else None
            limits = Limits(stopped, until=self._until, instructions=self._instructions)
            exact.run(limits)
            return exact.graph(look)
        words = max(1, -(-len(self.program.predicates) // 64))
        most = figures.transitions + figures.dropped
        first, labels = _zeros("Q", figures.states + 1), _zeros("Q", figures.states * words)
        target, actor, times = _zeros("q", most), _zeros("i", most), _zeros("q", most)
        turn = _zeros("H", most if self.symmetry.order > 1 else 0)
        parts = first, target, actor, times, labels, turn
        arrays = native.Arrays(*(part.buffer_info()[0] for part in parts))
        edges = 0
        for start in range(0, figures.states, native.STATES_AT_ONCE):
            look()
            end = min(start + native.STATES_AT_ONCE, figures.states)
            with self._asking(look):
                edges = self._library.rebsync_graph(self._engine, arrays, start, end, edges)
            if edges < 0:
                raise MemoryError
        for each in (target, actor, times, turn):
            del each[edges:]
        initial, order = tuple(range(figures.initials)), self.symmetry.order
        return Graph(first, target, actor, times, labels, words, initial, turn, order)

    def marks(self, graph: Graph) -> bytearray:
        """Which states of a graph go on for ever without time, and which can leave: as in C."""
        marks = bytearray(len(graph))
        arrays = (graph.first, graph.target, graph.time)
        places = (each.buffer_info()[0] for each in arrays)
        into = (ctypes.c_ubyte * max(1, len(marks))).from_buffer(marks or bytearray(1))
        if not self._library.rebsync_standstill(*places, len(graph), into):
            raise MemoryError
        return marks


def _zeros(code: str, count: int) -> array[Any]:
    empty: array[Any] = array(code, [0])
    return empty * count


def _event(program: Program, found: native.Event) -> Event:
    cause = cause_of(program, found.kind, found.pc, found.rebec)
    return Event(cause, found.state, found.ordinal)


def _libraries(
    program: Program, build: bool, wanted: Callable[[], bool]
) -> tuple[ctypes.CDLL, ctypes.CDLL]:
    """The search, and the model."""
    parts = tuple(header(name) for name in ("runtime.c", *native.PARTS))
    runtime = Unit("runtime", partial(header, "runtime.c"), parts, "-O2")
    search, bodies = libraries((runtime, model_unit(program)), build, wanted)
    native.declare(search)
    return search, bodies
