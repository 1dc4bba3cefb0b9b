"""Which lines of a model a run passes: what stands elsewhere has had no part in it."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.checker.machine import Coverage
from rebsync.checker.outcomes import Actor
from rebsync.checker.program import Program
from rebsync.checker.reached import reached_from
from rebsync.checker.simulate import next_step
from rebsync.checker.state import State
from rebsync.checker.steps import TIME, Action, Failure, Semantics
from rebsync.checker.telling import Teller
from rebsync.checker.trace import Trace
from rebsync.checker.views import view_of


def passed_lines(teller: Teller, trace: Trace) -> Iterator[frozenset[int]]:
    """The lines of the model that each step of a run of it passes; some more if in doubt.

    Those of the first step are the lines of constructors, whatever these choose.
    """
    program = teller.view.program
    state: State = ()
    for told in trace.steps:
        action = told.action
        if not state:
            reached = _constructed(program, teller.view.semantics)
        elif action.actor == TIME:
            reached = set()
        else:
            reached = _acted(teller, state, action)
        yield frozenset(teller.line(program.spans[pc]) for pc in reached)
        step = next_step(teller.view, state, action)
        assert step is not None, "a run that was found is one of the model"
        if isinstance(step.result, Failure):
            return
        state = step.result


def _constructed(program: Program, semantics: Semantics) -> set[int]:
    """The instructions that constructors run."""
    view = view_of(program, semantics)
    view.initial_states()
    bodies = {rebec.constructor for rebec in program.rebecs if rebec.constructor >= 0}
    entries = [program.bodies[number].entry for number in bodies]
    return reached_from(program, entries, view.coverage.branches)


def _acted(teller: Teller, state: State, action: Action) -> set[int]:
    """The instructions that a rebec runs in a step."""
    program, coverage, local = teller.view.program, Coverage(), state[action.actor]
    actor = Actor(program, action.actor, teller.view.semantics, coverage)
    if local.point:
        starts = [frame.pc for frame in local.point.frames]
    else:
        message = local.bag[action.slot]
        if message.deadline < 0:
            return set()
        starts = [program.bodies[program.servers[message.server].body].entry]
    actor.budget = teller.view.actors[action.actor].budget
    actor.act_again(local, action.slot, action.choices)
    return reached_from(program, starts, coverage.branches)
