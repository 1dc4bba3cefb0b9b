"""The three views of a model: exact (`tts`), floating time (`ftts`), and untimed (`core`).

A view is the definition of what a model does, to be read against the semantics in
docs/semantics.md; the compiled engine must agree with it in every number.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeAlias

from rebsync.checker.machine import Coverage, Sent
from rebsync.checker.outcomes import Actor, Outcome
from rebsync.checker.program import Program
from rebsync.checker.state import Local, State, later
from rebsync.checker.steps import TIME, Action, Failure, Semantics, Step

_Begun: TypeAlias = tuple[State | Failure, tuple[int, ...]]
"""The rebecs constructed so far, or what failed; and all that was chosen."""


class _Bodies:
    """What the views share: bodies run, and what they sent is delivered in order."""

    semantics: Semantics

    def __init__(self, program: Program, first: frozenset[int] = frozenset()) -> None:
        self.program = program
        self.first = sorted(first)
        self.coverage = Coverage()
        self.actors = [
            Actor(program, i, self.semantics, self.coverage) for i in range(len(program.rebecs))
        ]

    def initial_states(self) -> tuple[Step, ...]:
        """Constructors run in the order of main; those that fail leave no state."""
        return tuple(self._constructed())

    def _constructed(self) -> Iterator[Step]:
        """The ways to construct all rebecs, what the last one chooses changing first."""
        empty: State = tuple(Local((), ()) for _ in self.actors)
        begun: list[Iterator[_Begun]] = [iter([(empty, ())])]
        while begun:
            index = len(begun) - 1
            state, choices = next(begun[-1], (None, ()))
            if state is None:
                begun.pop()
            elif isinstance(state, Failure):
                yield Step(Action(TIME, -1, choices), state)
            elif index == len(self.actors):
                yield self._step(Action(TIME, -1, choices), state)
            else:
                begun.append(self._construct(state, index, choices))

    def _construct(self, state: State, index: int, choices: tuple[int, ...]) -> Iterator[_Begun]:
        """What the constructor of one more rebec makes of a state."""
        outcomes = tuple(self.actors[index].construct(state[index].bag))
        for outcome, result in self._delivered(state, index, outcomes):
            yield result, (*choices, *outcome.choices)

    def steps(self, state: State) -> tuple[Step, ...]:
        """Rebecs in the order of main, messages in that of the bag, choices from first to last."""
        ranks = [a.rank(local) for a, local in zip(self.actors, state, strict=True)]
        able = [rank for rank in ranks if rank is not None]
        if not able:
            return tuple(self._idle(state))
        for index in self.first:
            if ranks[index] is not None:
                steps = tuple(self._acts(state, index))
                if not any(isinstance(step.result, Failure) for step in steps):
                    return steps
        first = min(able)
        return tuple(
            s for i, rank in enumerate(ranks) if rank == first for s in self._acts(state, i)
        )

    def _acts(self, state: State, index: int) -> Iterator[Step]:
        outcomes = self.actors[index].outcomes(state[index])
        for outcome, result in self._delivered(state, index, outcomes):
            action = Action(index, outcome.slot, outcome.choices)
            if isinstance(result, Failure):
                yield Step(action, result)
            else:
                yield self._step(action, result)

    def next_state(self, state: State, action: Action) -> Step | None:
        """The step that an action makes; None when the state does not allow it."""
        return next((s for s in self.steps(state) if s.action == action), None)

    def is_deadlock(self, state: State) -> bool:
        """Whether all bags are empty and nobody is suspended."""
        return not any(local.bag or local.point for local in state)

    def _delivered(
        self, state: State, index: int, outcomes: tuple[Outcome, ...]
    ) -> Iterator[tuple[Outcome, State | Failure]]:
        """The outcomes with the states that they lead to.

        A body that fails by an overflow has run only up to there: what it would have chosen
        afterwards makes no further steps.
        """
        failed: tuple[int, tuple[int, ...]] | None = None
        for outcome in outcomes:
            if failed and failed == (outcome.slot, outcome.choices[: len(failed[1])]):
                continue
            result, sent = self._deliver(state, index, outcome)
            if sent is not None:
                failed = (outcome.slot, outcome.choices[: sent.choices])
                outcome = replace(outcome, choices=failed[1])
            yield outcome, result

    def _deliver(
        self, state: State, index: int, outcome: Outcome
    ) -> tuple[State | Failure, Sent | None]:
        locals_ = list(state)
        for sent in outcome.sends:
            if sent.receiver == index:
                continue
            received = self.actors[sent.receiver].receive(locals_[sent.receiver], sent.message)
            if received is None:
                return Failure("overflow", sent.pc, sent.receiver), sent
            locals_[sent.receiver] = received
        if isinstance(outcome.result, Failure):
            return outcome.result, None
        locals_[index] = outcome.result
        return tuple(locals_), None

    def _step(self, action: Action, state: State) -> Step:
        """The step to a state; the floating view lets time pass in it."""
        return Step(action, state)

    def _idle(self, state: State) -> Iterator[Step]:
        """What happens when nobody can act."""
        return iter(())

    def _later(self, state: State, time: int) -> State:
        return tuple(later(local, time, self.program.reads_clock) for local in state)


class Exact(_Bodies):
    """One global clock; a `delay` splits a body; time passes in steps of its own."""

    semantics: Semantics = "tts"

    def _idle(self, state: State) -> Iterator[Step]:
        times = [_next(local) for local in state]
        waited = [time for time in times if time is not None]
        if waited:
            time = min(waited)
            yield Step(Action(TIME), self._later(state, time), time)


def _next(local: Local) -> int | None:
    """When a rebec that cannot act now will be able to."""
    if local.point:
        return local.busy
    return local.bag[0].arrival if local.bag else None


class Floating(_Bodies):
    """A body runs whole and leaves its rebec busy; the step goes on to when somebody can act."""

    semantics: Semantics = "ftts"

    def _step(self, action: Action, state: State) -> Step:
        times = [max(local.busy, local.bag[0].arrival, 0) for local in state if local.bag]
        time = min(times, default=0)
        return Step(action, self._later(state, time), time)


class Untimed(_Bodies):
    """Core Rebeca: queues, and no time."""

    semantics: Semantics = "core"


Views: TypeAlias = Exact | Floating | Untimed


def view_of(program: Program, semantics: Semantics, first: frozenset[int] = frozenset()) -> Views:
    """The view by its name.

    Of the rebecs in `first` one that can act without failing acts alone (partial-order reduction,
    see `reduction.py`).
    """
    match semantics:
        case "tts":
            return Exact(program, first)
        case "ftts":
            return Floating(program, first)
        case "core":
            return Untimed(program, first)
