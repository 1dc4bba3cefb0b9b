"""Runs are confirmed: what the search says is wrong is seen again where its run ends."""

from __future__ import annotations

from rebsync.checker.exploration import Event
from rebsync.checker.machine import Failed
from rebsync.checker.search import Interpreted
from rebsync.checker.steps import Failure, Step
from rebsync.checker.telling import Teller


def confirmed(teller: Teller, path: tuple[int, ...], event: Event) -> tuple[int, ...]:
    """The path, after walking along it from the initial state and seeing the event at its end.

    Of a search over orbits nothing is asked: there a predicate may stand for an equal one of
    another rebec. Raises RuntimeError if the run does not show the event, which is a mistake of
    the search, or of its file of steps.
    """
    if teller.orbits:
        return path
    try:
        shown = _shows(teller, path, event)
    except (IndexError, AssertionError):  # no such step, or one that fails
        shown = False
    if not shown:
        raise RuntimeError(f"the run to state {event.state} does not show what was found there")
    return path


def _shows(teller: Teller, path: tuple[int, ...], event: Event) -> bool:
    view, states = teller.view, teller.states(path)
    state = states[-1] if states else ()
    match event.cause:
        case Failure() as failure if event.ordinal >= 0:
            steps = view.steps(state) if states else view.initial_states()
            return _fails(steps[event.ordinal], failure)
        case Failure():  # of a predicate, which has no value
            return True
        case int(predicate):
            try:
                return not Interpreted(view.program, view.semantics).holds(state, predicate)
            except Failed:
                return False
        case "deadlock":
            return view.is_deadlock(state)
        case _:  # a run to a state of which nothing was said
            return True


def _fails(step: Step, failure: Failure) -> bool:
    found = step.result
    return isinstance(found, Failure) and (found.kind, found.pc) == (failure.kind, failure.pc)
