"""What else could happen: the steps that are possible before and after each step of a run.

The steps are those of the successor function of a view, told by the same `Teller` as the run.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from random import Random
from typing import TypeAlias

from rebsync.checker.endless import EndlessBody, endless_reason
from rebsync.checker.state import State
from rebsync.checker.steps import Failure, Step
from rebsync.checker.telling import Teller
from rebsync.checker.trace import Trace, TraceStep
from rebsync.records import dataclass

MOST_TOLD = 12  # steps that are told of one state


@dataclass(frozen=True, slots=True)
class Successor:
    """A step that is possible in a state; `ordinal` is its place among all that are."""

    ordinal: int
    step: TraceStep
    is_taken: bool = False


@dataclass(frozen=True, slots=True)
class Branching:
    """The possible steps of one state, at most MOST_TOLD of them, and the one that the run takes.

    `count` is how many there are. `unknown` says why they are not known; then there are none here.
    """

    successors: tuple[Successor, ...]
    count: int
    unknown: str | None = None

    @property
    def taken(self) -> int | None:
        """The ordinal of the step that the run takes; None at its end."""
        return next((each.ordinal for each in self.successors if each.is_taken), None)

    @property
    def is_end(self) -> bool:
        """Whether nothing can happen in the state."""
        return self.unknown is None and self.count == 0


Branchings: TypeAlias = tuple[Branching, ...]
"""For each step of a run what was possible in its place; last, what is after the run."""

Branches: TypeAlias = Callable[[Trace], Branchings]
"""What else could happen in a run; nothing at all where nobody can tell."""


def unbranched(_: Trace) -> Branchings:
    """Of a run of which only the run is known."""
    return ()


def branchings(teller: Teller, trace: Trace) -> Branchings:
    """What was possible in the place of each step of a run, and what is after it.

    They end where the steps of a state are not known, and where the run is none of the view.
    """
    state: State = ()
    time = 0
    found: list[Branching] = []
    for told in trace.steps:
        branching, step = _branching(teller, told.number, time, state, told)
        found.append(branching)
        if step is None or isinstance(step.result, Failure):
            return tuple(found)
        state, time = step.result, time + step.time
    found.append(_branching(teller, len(trace.steps), time, state, None)[0])
    return tuple(found)


class NoSuchStep(Exception):
    """A state has no step of this ordinal, or its steps are not known; `number` is the step's."""

    def __init__(self, number: int, reason: str) -> None:
        super().__init__(reason)
        self.number = number


def run_along(teller: Teller, ordinals: Sequence[int], by_chance: int = 0) -> Trace:
    """The run along the ordinals of an initial state, and of a step in each state.

    It goes on by chance for so many steps, or until none is possible, or known. Raises NoSuchStep.
    A step that fails must be the last one.
    """
    state: State = ()
    time = 0
    told: list[TraceStep] = []
    random = Random()
    for number in range(len(ordinals) + by_chance):
        is_asked = number < len(ordinals)
        steps = _possible(teller, state, told)
        if not is_asked and (isinstance(steps, str) or len(steps) == 0):
            break
        if isinstance(steps, str):
            raise NoSuchStep(number, steps)
        ordinal = ordinals[number] if is_asked else random.randrange(len(steps))
        if not 0 <= ordinal < len(steps):
            raise NoSuchStep(number, f"there are {len(steps)} possible steps")
        step = steps[ordinal]
        told.append(teller.step(number, time, state, step))
        if not isinstance(step.result, Failure):
            state, time = step.result, time + step.time
    return Trace(teller.source.path, teller.view.semantics, tuple(told))


def _possible(teller: Teller, state: State, told: Sequence[TraceStep]) -> Sequence[Step] | str:
    """The possible steps after those that were told, or why there are none that are known."""
    if told and told[-1].failure is not None:
        return "nothing is possible after a step that fails"
    return _steps(teller, state)


def _branching(
    teller: Teller, number: int, time: int, state: State, taken: TraceStep | None
) -> tuple[Branching, Step | None]:
    """What is possible in a state, and of it the step that a run takes."""
    steps = _steps(teller, state)
    if isinstance(steps, str):
        return Branching((), 0, steps), None
    found = next(
        (i for i, each in enumerate(steps) if taken is not None and each.action == taken.action),
        None,
    )
    successors = tuple(
        Successor(ordinal, teller.step(number, time, state, steps[ordinal]), ordinal == found)
        for ordinal in _told(len(steps), found)
    )
    return Branching(successors, len(steps)), None if found is None else steps[found]


def _told(count: int, taken: int | None) -> Iterator[int]:
    """The ordinals that are told: the first ones, and in any case the one that is taken."""
    yield from range(min(count, MOST_TOLD))
    if taken is not None and taken >= MOST_TOLD:
        yield taken


def _steps(teller: Teller, state: State) -> Sequence[Step] | str:
    """The possible steps, or why they are not known: one of the bodies does not end."""
    view = teller.view
    try:
        return view.steps(state) if state else view.initial_states()
    except EndlessBody as endless:
        return endless_reason(view.program, endless.cut, teller.source)
