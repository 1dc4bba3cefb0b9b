"""Breadth-first search with the interpreter."""

from __future__ import annotations

import time
from array import array
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import TypeAlias

from rebsync.checker.endless import EndlessBody, endless_reason
from rebsync.checker.exploration import (
    Covered,
    Event,
    Exploration,
    Extremes,
    Limits,
    Progress,
    Report,
    bound_of_states,
    kinds_of,
)
from rebsync.checker.graph import Graph
from rebsync.checker.look import Look, Stopped, unwatched
from rebsync.checker.machine import Failed, Machine
from rebsync.checker.memory import NO_MEMORY, used_memory
from rebsync.checker.orbits import Orbits
from rebsync.checker.program import NO_DEADLINE, Program
from rebsync.checker.reduction import PersistentSets
from rebsync.checker.standstill import marks_of
from rebsync.checker.state import Message, State
from rebsync.checker.steps import Failure, Semantics, Step
from rebsync.checker.symmetry import Symmetry
from rebsync.checker.views import view_of

PAUSED = "paused"
FIRST = "the search was stopped at the first violation: --all looks for all"
_SLICE = 0.05  # seconds between two looks at the bounds

Pause: TypeAlias = Callable[[], bool]


class Interpreted:
    """A search that starts at once. `invariants` are the predicates whose failure is an event."""

    def __init__(
        self,
        program: Program,
        semantics: Semantics,
        invariants: tuple[int, ...] = (),
        persistent: PersistentSets = (),
        symmetry: Symmetry | None = None,
    ) -> None:
        self.program = program
        self.semantics: Semantics = semantics
        self.symmetry = symmetry or Symmetry()
        self._orbits = Orbits(semantics, self.symmetry)
        self.view = view_of(program, semantics, persistent)
        self.invariants = invariants
        self.persistent = persistent
        self.states: list[State] = []
        self.numbers: dict[State, int] = {}
        self._parents: list[int] = []  # -1 - ordinal for initial states
        self._codes: list[int] = []
        self._depths = array("l")
        self._times: list[int] = []
        self._expanded = 0
        self._transitions = 0
        self._events: dict[object, Event] = {}  # by cause
        self._measured = [Extremes(0, -1, 0, -1, -1)] * len(program.measures)
        self._until_reached = False
        self._spent = 0.0
        self._look_at_bounds: Look = unwatched

    def run(
        self, limits: Limits, report: Report | None = None, pause: Pause | None = None
    ) -> Exploration:
        """Searches on from where an earlier run stopped.

        Ends with the reason PAUSED soon after `pause` has become true.
        """
        started = time.perf_counter() - self._spent
        reason, cut = None, None
        self.view.limit(limits.instructions)
        try:
            reason = self._search(limits, report, started, pause)
        except KeyboardInterrupt:
            reason = "it was interrupted"
        except Stopped as stopped:
            reason = str(stopped)
        except EndlessBody as endless:
            cut = endless.cut
            reason = endless_reason(self.program, cut)
        except MemoryError:
            reason = NO_MEMORY
        if reason is None and self._until_reached:
            reason = f"the bound of {limits.until} units of time was reached"
        self._spent = time.perf_counter() - started
        return Exploration(
            len(self.states),
            self._transitions,
            self._depths[-1] if self._depths else 0,
            tuple(self._events.values()),
            self._covered(),
            self.semantics,
            "interpreted",
            self._spent,
            0.0,
            used_memory(),
            reason,
            cut=cut,
            measured=tuple(self._measured),
        )

    def _covered(self) -> Covered:
        coverage = self.view.coverage
        largest = tuple(actor.largest for actor in self.view.actors)
        return Covered(frozenset(coverage.servers), frozenset(coverage.branches), largest)

    # --- searching

    def _search(
        self, limits: Limits, report: Report | None, started: float, pause: Pause | None
    ) -> str | None:
        due = time.perf_counter() + _SLICE

        def look(ends: bool = False) -> None:
            nonlocal due
            now = time.perf_counter()
            if now >= due:
                due = now + _SLICE
                if stop := self._look(limits, report, now - started):
                    raise Stopped(stop)
                if pause and not ends and pause():
                    raise Stopped(PAUSED)

        self._look_at_bounds = partial(look, ends=True)
        self._stop_at_first(limits)
        with self._looking(look):
            if not self.states:
                for ordinal, step in enumerate(self.view.initial_states()):
                    self._reach(step, -1, ordinal, limits)
                    self._stop_at_first(limits)
            while self._expanded < len(self.states):
                if limits.states is not None and len(self.states) >= limits.states:
                    return bound_of_states(limits.states)
                look()
                self._expand(self._expanded, limits)
        return None

    @contextmanager
    def _looking(self, look: Look) -> Iterator[None]:
        """A body that can choose in many ways must not outlast the bounds."""
        for actor in self.view.actors:
            actor.look = look
        try:
            yield
        finally:
            self._look_at_bounds = unwatched
            for actor in self.view.actors:
                actor.look = unwatched

    def _look(self, limits: Limits, report: Report | None, seconds: float) -> str | None:
        memory = used_memory()
        if report:
            report(
                Progress(
                    len(self.states),
                    self._transitions,
                    self._depths[self._expanded] if self._depths else 0,
                    len(self.states) - self._expanded,
                    seconds,
                    memory,
                    violations=kinds_of(self._events, limits.faults),
                )
            )
        return limits.out_of_time(seconds) or limits.out_of_memory(memory)

    def _expand(self, number: int, limits: Limits) -> None:
        for ordinal, step in enumerate(self.view.steps(self.states[number])):
            self._reach(step, number, ordinal, limits)
            self._stop_at_first(limits)
        self._expanded += 1

    def _stop_at_first(self, limits: Limits) -> None:
        if limits.first and any(map(limits.faults.includes, self._events)):
            raise Stopped(FIRST)

    def _reach(self, step: Step, parent: int, ordinal: int, limits: Limits) -> None:
        reached = step.time + (self._times[parent] if parent >= 0 else 0)
        if limits.until is not None and reached > limits.until:
            self._until_reached = True
            return
        self._transitions += parent >= 0
        if isinstance(step.result, Failure):
            self._event(step.result, Event(step.result, parent, ordinal))
            return
        state, turn = self._orbits.representative(step.result)
        if state in self.numbers:
            return
        number = self.numbers[state] = len(self.states)
        self.states.append(state)
        self._parents.append(parent)
        self._codes.append(ordinal * self.symmetry.order + turn)
        self._depths.append(self._depths[parent] + 1 if parent >= 0 else 0)
        self._times.append(reached)
        self._judge(state, number)

    def _judge(self, state: State, number: int) -> None:
        for predicate in self.invariants:
            self._look_at_bounds()  # and no pause, after which this state would not be judged
            try:
                holds = self.holds(state, predicate)
            except Failed as failed:
                self._event(failed.failure, Event(failed.failure, number))
                continue
            if not holds:
                self._event(predicate, Event(predicate, number))
        if self.view.is_deadlock(state):
            self._event("deadlock", Event("deadlock", number))

        for index, body in enumerate(self.program.measures):
            self._measured[index] = self._extended(self._measured[index], body, state, number)

    def _extended(self, known: Extremes, body: int, state: State, number: int) -> Extremes:
        """The extremes of a measure with one more state."""
        try:
            value = self.value(state, body)
        except Failed:
            return known if known.undefined >= 0 else replace(known, undefined=number)
        if known.least_state < 0 or value < known.least:
            known = replace(known, least=value, least_state=number)
        if known.greatest_state < 0 or value > known.greatest:
            known = replace(known, greatest=value, greatest_state=number)
        return known

    def _event(self, cause: object, event: Event) -> None:
        self._events.setdefault(cause, event)

    def holds(self, state: State, predicate: int) -> bool:
        """Whether a predicate is true in a state; raises Failed if it has no value."""
        return bool(self.value(state, self.program.predicates[predicate]))

    def value(self, state: State, body: int) -> int:
        """What a predicate or measure computes from a state; raises Failed if it has no value."""
        message = Message(0, -1, 0, NO_DEADLINE, ())
        machine = Machine(
            self.program, self.program.rebecs[0], -1, [], message, 0, [], False, 0, states=state
        )
        machine.look = self._look_at_bounds
        machine.start(body, ())
        return machine.stack[-1]

    # --- afterwards

    def path(self, state: int) -> tuple[int, ...]:
        """A shortest way to a state: the code of the initial state, then one for each step."""
        codes = []
        while state >= 0:
            codes.append(self._codes[state])
            state = self._parents[state]
        return tuple(reversed(codes))

    def graph(self, look: Look = unwatched) -> Graph:
        """The state space that was seen; steps to states that were not seen are left out."""
        self._look_at_bounds = look
        words = max(1, -(-len(self.program.predicates) // 64))
        first, target, actor = array("Q", [0]), array("q"), array("i")
        times, labels, turns = array("q"), array("Q"), array("H")
        for number, state in enumerate(self.states):
            look()
            for step in self.view.steps(state) if number < self._expanded else ():
                failed = isinstance(step.result, Failure)
                to, turn = self._target(step.result)
                if to == -2:
                    continue
                if self.symmetry.order > 1:
                    turns.append(turn)
                target.append(to)
                actor.append(step.action.actor)
                times.append(0 if failed else step.time)
            first.append(len(target))
            labels.extend(self._labels(state, words))
        initial = tuple(n for n, parent in enumerate(self._parents) if parent < 0)
        order = self.symmetry.order
        return Graph(first, target, actor, times, labels, words, initial, turns, order)

    def _target(self, result: State | Failure) -> tuple[int, int]:
        """The state that a step leads to, and what made it canonical; -1 none, -2 not seen."""
        if isinstance(result, Failure):
            return -1, 0
        state, turn = self._orbits.representative(result)
        return self.numbers.get(state, -2), turn

    def marks(self, graph: Graph) -> bytearray:
        """Which states of a graph go on for ever without time, and which can leave."""
        return marks_of(graph)

    def _labels(self, state: State, words: int) -> list[int]:
        bits = 0
        for predicate in range(len(self.program.predicates)):
            bits |= self._true(state, predicate) << predicate
        return [bits >> (64 * word) & (2**64 - 1) for word in range(words)]

    def _true(self, state: State, predicate: int) -> bool:
        try:
            return self.holds(state, predicate)
        except Failed:
            return False
