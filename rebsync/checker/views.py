"""The three views of a model: exact (`tts`), floating time (`ftts`), and untimed (`core`).

A view is the definition of what a model does, to be read against the semantics in
docs/semantics.md; the compiled engine must agree with it in every number.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias, overload

from rebsync.checker.machine import Coverage, Sent
from rebsync.checker.outcomes import Actor, Outcome
from rebsync.checker.program import NO_DEADLINE, Program
from rebsync.checker.reduction import PersistentSets
from rebsync.checker.state import Local, State, later
from rebsync.checker.steps import TIME, Action, Failure, Semantics, Step

NEVER = NO_DEADLINE  # a wait longer than every other

_Begun: TypeAlias = tuple[State | Failure, tuple[int, ...]]
"""The rebecs constructed so far, or what failed; and all that was chosen."""

_Changes: TypeAlias = dict[int, Local]
"""The rebecs that a step changes, by their numbers: a state may have many more."""

_Maker: TypeAlias = Callable[[Action, _Changes], Step]


class Steps(Sequence[Step]):
    """The steps of a state, each made when it is asked for: it holds the state that it leads to."""

    def __init__(
        self,
        make: Callable[[Action, _Changes], Step],
        moves: list[tuple[Action, _Changes | Failure]],
    ) -> None:
        self._make = make
        self._moves = moves

    def __len__(self) -> int:
        return len(self._moves)

    def actions(self) -> list[Action]:
        """The actions of the steps, without the states that they lead to."""
        return [action for action, _ in self._moves]

    @overload
    def __getitem__(self, index: int) -> Step: ...
    @overload
    def __getitem__(self, index: slice) -> Steps: ...
    def __getitem__(self, index: int | slice) -> Step | Steps:
        if isinstance(index, slice):
            return Steps(self._make, self._moves[index])
        action, changes = self._moves[index]
        return (
            Step(action, changes) if isinstance(changes, Failure) else self._make(action, changes)
        )


class _Bodies:
    """What the views share: bodies run, and what they sent is delivered in order."""

    semantics: Semantics

    def __init__(self, program: Program, persistent: PersistentSets = ()) -> None:
        self.program = program
        self.persistent = persistent
        self.coverage = Coverage()
        self.actors = [
            Actor(program, i, self.semantics, self.coverage) for i in range(len(program.rebecs))
        ]

    def limit(self, instructions: int) -> None:
        """From now on a body is given up after so many instructions."""
        for actor in self.actors:
            actor.budget = instructions

    def initial_states(self) -> tuple[Step, ...]:
        """Constructors run in the order of main; those that fail leave no state."""
        return tuple(self._constructed())

    def _constructed(self) -> Iterator[Step]:
        """The ways to construct all rebecs; up to the first that has several, one after another."""
        locals_ = [Local((), ()) for _ in self.actors]
        choices: tuple[int, ...] = ()
        for index, actor in enumerate(self.actors):
            outcomes = tuple(actor.construct(locals_[index].bag))
            if len(outcomes) > 1:
                yield from self._branching(tuple(locals_), index, choices)
                return
            changes, _ = self._deliver(locals_, index, outcomes[0])
            choices = (*choices, *outcomes[0].choices)
            if isinstance(changes, Failure):
                yield Step(Action(TIME, -1, choices), changes)
                return
            for number, local in changes.items():
                locals_[number] = local
        yield self._step(Action(TIME, -1, choices), tuple(locals_))

    def _branching(self, start: State, first: int, chosen: tuple[int, ...]) -> Iterator[Step]:
        """The ways to construct the rebecs from `first` on; the last one's choices change first."""
        begun: list[Iterator[_Begun]] = [iter([(start, chosen)])]
        while begun:
            index = first + len(begun) - 1
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
            reached = result if isinstance(result, Failure) else _changed(state, result)
            yield reached, (*choices, *outcome.choices)

    def steps(self, state: State) -> Sequence[Step]:
        """Rebecs in the order of main, messages in that of the bag, choices from first to last."""
        ranks = [a.rank(local) for a, local in zip(self.actors, state, strict=True)]
        able = [rank for rank in ranks if rank is not None]
        if not able:
            return tuple(self._idle(state))
        make = self._maker(state)
        for index, disturbers in self.persistent:
            if ranks[index] is None or any(ranks[other] is not None for other in disturbers):
                continue
            moves = list(self._acts(state, index))
            if not any(isinstance(changes, Failure) for _, changes in moves):
                return Steps(make, moves)
        first = min(able)
        acting = (i for i, rank in enumerate(ranks) if rank == first)
        return Steps(make, [move for i in acting for move in self._acts(state, i)])

    def _acts(self, state: State, index: int) -> Iterator[tuple[Action, _Changes | Failure]]:
        outcomes = self.actors[index].outcomes(state[index])
        for outcome, result in self._delivered(state, index, outcomes):
            yield Action(index, outcome.slot, outcome.choices), result

    def _maker(self, state: State) -> _Maker:
        """What makes the steps of one state."""
        return lambda action, changes: self._step(action, _changed(state, changes))

    def next_state(self, state: State, action: Action) -> Step | None:
        """The step that an action makes; None when the state does not allow it."""
        return next((s for s in self.steps(state) if s.action == action), None)

    def is_deadlock(self, state: State) -> bool:
        """Whether all bags are empty and nobody is suspended."""
        return not any(local.bag or local.point for local in state)

    def _delivered(
        self, state: State, index: int, outcomes: tuple[Outcome, ...]
    ) -> Iterator[tuple[Outcome, _Changes | Failure]]:
        """The outcomes with what they change.

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
        self, state: Sequence[Local], index: int, outcome: Outcome
    ) -> tuple[_Changes | Failure, Sent | None]:
        changes: _Changes = {}
        for sent in outcome.sends:
            if sent.receiver == index:
                continue
            before = changes.get(sent.receiver) or state[sent.receiver]
            received = self.actors[sent.receiver].receive(before, sent.message)
            if received is None:
                return Failure("overflow", sent.pc, sent.receiver), sent
            changes[sent.receiver] = received
        if isinstance(outcome.result, Failure):
            return outcome.result, None
        changes[index] = outcome.result
        return changes, None

    def _step(self, action: Action, state: State) -> Step:
        """The step to a state; the floating view lets time pass in it."""
        return Step(action, state)

    def _idle(self, state: State) -> Iterator[Step]:
        """What happens when nobody can act."""
        return iter(())

    def _later(self, state: State, time: int) -> State:
        if not time:
            return state
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


def _changed(state: State, changes: _Changes) -> State:
    locals_ = list(state)
    for index, local in changes.items():
        locals_[index] = local
    return tuple(locals_)


def _next(local: Local) -> int | None:
    """When a rebec that cannot act now will be able to."""
    if local.point:
        return local.busy
    return local.bag[0].arrival if local.bag else None


class Floating(_Bodies):
    """A body runs whole and leaves its rebec busy; the step goes on to when somebody can act."""

    semantics: Semantics = "ftts"

    def _step(self, action: Action, state: State) -> Step:
        time = min(map(_wait, state), default=0)
        time = 0 if time == NEVER else time
        return Step(action, self._later(state, time), time)

    def _maker(self, state: State) -> _Maker:
        waits = list(map(_wait, state))
        soonest = sorted(range(len(waits)), key=waits.__getitem__)

        def make(action: Action, changes: _Changes) -> Step:
            others = next((waits[i] for i in soonest if i not in changes), NEVER)
            time = min(others, *map(_wait, changes.values()))
            time = 0 if time == NEVER else time
            return Step(action, self._later(_changed(state, changes), time), time)

        return make


def _wait(local: Local) -> int:
    """How long it is in the floating view until a rebec can take a message."""
    return max(local.busy, local.bag[0].arrival, 0) if local.bag else NEVER


class Untimed(_Bodies):
    """Core Rebeca: queues, and no time."""

    semantics: Semantics = "core"


Views: TypeAlias = Exact | Floating | Untimed


def view_of(program: Program, semantics: Semantics, persistent: PersistentSets = ()) -> Views:
    """The view by its name.

    Of the rebecs in `persistent` one that nobody disturbs acts alone where it cannot fail
    (partial-order reduction, see `reduction.py`).
    """
    match semantics:
        case "tts":
            return Exact(program, persistent)
        case "ftts":
            return Floating(program, persistent)
        case "core":
            return Untimed(program, persistent)
