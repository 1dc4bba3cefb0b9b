"""Single runs: by chance, by hand, or as recorded."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from random import Random
from typing import TypeAlias

from rebsync.checker.endless import EndlessBody
from rebsync.checker.state import State
from rebsync.checker.steps import Action, Failure, Step
from rebsync.checker.telling import Teller
from rebsync.checker.trace import Trace, TraceStep
from rebsync.checker.views import Views

Chooser: TypeAlias = Callable[[int, State, Sequence[Step]], int | None]
"""Picks one of the possible steps, at a time since the start; None ends the run."""


def by_chance(seed: int) -> Chooser:
    """Every possible step is as likely as any other."""
    random = Random(seed)
    return lambda time, state, steps: random.randrange(len(steps))


def run(
    teller: Teller, choose: Chooser, *, until: int | None = None, steps: int | None = None
) -> Iterator[TraceStep]:
    """The steps of one run as they are shown."""
    for made in walk(teller.view, choose, until=until, steps=steps):
        yield teller.step(*made)


def walk(
    view: Views, choose: Chooser, *, until: int | None = None, steps: int | None = None
) -> Iterator[tuple[int, int, State, Step]]:
    """One run, until it ends, time passes `until`, or `steps` were made.

    Of each step its number, the time and the state before it, and the step.
    """
    state: State = ()
    time = number = 0
    while steps is None or number <= steps:
        possible = view.steps(state) if number else view.initial_states()
        if until is not None:
            possible = tuple(s for s in possible if time + s.time <= until)
        picked = choose(time, state, possible) if len(possible) > 0 else None
        if picked is None:
            return
        step = possible[picked]
        yield number, time, state, step
        if isinstance(step.result, Failure):
            return
        state, time, number = step.result, time + step.time, number + 1


class NotARun(Exception):
    """A recorded run that the model does not have; `number` is the first step that differs.

    With `repeats` it is the step after which the run is said to repeat, and does not.
    """

    def __init__(self, number: int, repeats: bool = False) -> None:
        super().__init__(number, repeats)
        self.number = number
        self.repeats = repeats


def replay(teller: Teller, actions: Sequence[Action], loop: int | None) -> Trace:
    """The run that consists of recorded actions. Raises NotARun."""
    state: State = ()
    time = 0
    told: list[TraceStep] = []
    states: list[State] = []
    for number, action in enumerate(actions):
        step = next_step(teller.view, state, action)
        if step is None:
            raise NotARun(number)
        told.append(teller.step(number, time, state, step))
        time += step.time
        if isinstance(step.result, Failure):
            if number < len(actions) - 1:
                raise NotARun(number + 1)
            break
        state = step.result
        states.append(state)
    if loop is not None and (loop >= len(told) - 1 or [states[loop]] != states[len(told) - 1 :]):
        raise NotARun(loop, repeats=True)
    return Trace(teller.source.path, teller.view.semantics, tuple(told), loop)


def next_step(view: Views, state: State, action: Action) -> Step | None:
    """The step that an action makes in a state, or at the start; None if there is none."""
    try:
        if state:
            return view.next_state(state, action)
        return next((s for s in view.initial_states() if s.action == action), None)
    except EndlessBody:
        return None
