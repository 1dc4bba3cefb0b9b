"""What the bodies of a run do to their robots: its steps, run again with the moves that they make.

A step says who acted, on which message, with which choices. The program with moves has the same
steps as the one without, so that the interpreter finds the bodies that ran.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal, TypeAlias

from rebsync.checker.course import Course, Delayed, Moved
from rebsync.checker.endless import EndlessBody
from rebsync.checker.lowering import lower
from rebsync.checker.outcomes import Outcome
from rebsync.checker.program import Program
from rebsync.checker.state import Local, State
from rebsync.checker.steps import TIME, Action, Failure
from rebsync.checker.trace import Trace
from rebsync.checker.views import Exact, Floating, Views
from rebsync.records import dataclass
from rebsync.static import Analysis

_VIEWS: dict[str, type[Views]] = {"tts": Exact, "ftts": Floating}

Kind: TypeAlias = Literal["move", "lost", "delay", "end"]


@dataclass(frozen=True, slots=True)
class Deed:
    """What a body did at a time: a move by (x, y), a delay that begins, or its end.

    "lost" is a move whose offsets are not known.
    """

    rebec: str
    time: int
    kind: Kind
    x: int = 0
    y: int = 0
    duration: int = 0


def deeds(trace: Trace, analysis: Analysis) -> tuple[Deed, ...] | None:
    """What bodies did in a run of a model, in its order; None when it is no run of the model.

    Of a run without time (core Rebeca) there is nothing to tell: None as well.
    """
    view: type[Views] | None = _VIEWS.get(trace.semantics)
    if view is None:
        return None
    program, _ = lower(analysis, moves=True)
    try:
        return tuple(_deeds(trace, view(program)))
    except (_Different, EndlessBody):
        return None


class _Different(Exception):
    """The model does not do what the run says."""


def _deeds(trace: Trace, view: Views) -> Iterator[Deed]:
    state: State = ()
    for step in trace.steps:
        if not state:
            first = next((s for s in view.initial_states() if s.action == step.action), None)
            if first is None:
                raise _Different
            yield from _constructed(view, step.action)
            result = first.result
        else:
            taken = view.next_state(state, step.action)
            if taken is None:
                raise _Different
            if step.action.actor != TIME:
                outcome = _outcome(view, state, step.action)
                yield from _done(view.program, step.action.actor, step.time, outcome, taken.result)
            result = taken.result
        if isinstance(result, Failure):
            return
        state = result


def _constructed(view: Views, action: Action) -> Iterator[Deed]:
    """What the constructors did: the choices of the step are theirs, one after the other."""
    at = 0
    for index, actor in enumerate(view.actors):
        outcomes = actor.construct(())
        outcome = next(
            (o for o in outcomes if o.choices == action.choices[at : at + len(o.choices)]), None
        )
        if outcome is None:
            raise _Different
        at += len(outcome.choices)
        yield from _done(view.program, index, 0, outcome, outcome.result)


def _outcome(view: Views, state: State, action: Action) -> Outcome:
    outcomes = view.actors[action.actor].outcomes(state[action.actor])
    chosen = len(action.choices)
    return next(
        o for o in outcomes if (o.slot, o.choices[:chosen]) == (action.slot, action.choices)
    )


def _done(
    program: Program,
    index: int,
    time: int,
    outcome: Outcome,
    result: State | Local | Failure,
) -> Iterator[Deed]:
    """What one body did, up to where it failed, if it did."""
    rebec = program.rebecs[index].name
    for event in _before(outcome, result):
        at = time + event.elapsed
        match event:
            case Moved(_, _, int() as x, int() as y):
                yield Deed(rebec, at, "move", x, y)
            case Moved():
                yield Deed(rebec, at, "lost")
            case Delayed(_, _, duration, _):
                yield Deed(rebec, at, "delay", duration=duration)
    local = outcome.result
    if not isinstance(result, Failure) and isinstance(local, Local) and local.point is None:
        yield Deed(rebec, time + local.busy, "end")


def _before(outcome: Outcome, result: State | Local | Failure) -> Sequence[Course]:
    """The moves and delays before a message that found no place."""
    if not isinstance(result, Failure) or result.kind != "overflow":
        return outcome.course
    sends = next(
        (n for n, s in enumerate(outcome.sends) if (s.pc, s.receiver) == (result.pc, result.rebec)),
        len(outcome.sends),
    )
    return [event for event in outcome.course if event.sends <= sends]
