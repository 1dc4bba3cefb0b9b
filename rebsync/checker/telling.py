"""Steps told in the words of the model: names, values, lines, and times since the start."""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

from rebsync.checker.machine import Sent
from rebsync.checker.orbits import Orbits, run_of
from rebsync.checker.outcomes import Outcome
from rebsync.checker.program import KINDS, NO_DEADLINE, Cell, Kind, Slot
from rebsync.checker.state import Local, Message, State
from rebsync.checker.steps import TIME, Action, Failure, Step
from rebsync.checker.trace import Change, ShownMessage, ShownRebec, Trace, TraceStep
from rebsync.checker.values import shown
from rebsync.checker.views import Views
from rebsync.records import dataclass
from rebsync.source import Source, Span


class Deed(NamedTuple):
    """What happens in a step, in the terms of a TraceStep."""

    kind: str
    rebec: str
    message: ShownMessage | None
    choices: tuple[str, ...]
    failure: str | None


@dataclass(frozen=True, slots=True)
class Teller:
    """Tells the steps of one view; `source` is the text of the model.

    With `orbits` the runs that it is asked for lead through their canonical states.
    """

    view: Views
    source: Source
    orbits: Orbits | None = None

    # --- runs

    def trace(self, path: tuple[int, ...], failing: int = -1, loop: int | None = None) -> Trace:
        """The run along ordinals: of an initial state, then of a step in each state.

        With `failing` the run ends in the step of that ordinal, which has no successor. `loop` is
        the number of the step to whose state the run returns.
        """
        if self.orbits:
            path, failing, loop, _ = run_of(self.view, self.orbits, path, failing, loop)
        ordinals = (*path, failing) if failing >= 0 else path
        steps: list[TraceStep] = []
        state: State = ()
        time = 0
        for number, ordinal in enumerate(ordinals):
            choices = self.view.steps(state) if number else self.view.initial_states()
            step = choices[ordinal]
            steps.append(self.step(number, time, state, step))
            time += step.time
            if not isinstance(step.result, Failure):
                state = step.result
        return Trace(self.source.path, self.view.semantics, tuple(steps), loop)

    def states(self, path: tuple[int, ...]) -> tuple[State, ...]:
        """The states along ordinals, that after each step."""
        states: list[State] = []
        if self.orbits:
            path = run_of(self.view, self.orbits, path).path
        for ordinal in path:
            steps = self.view.steps(states[-1]) if states else self.view.initial_states()
            result = steps[ordinal].result
            assert not isinstance(result, Failure)
            states.append(result)
        return tuple(states)

    def rebec_at(self, path: tuple[int, ...], rebec: int) -> int:
        """The rebec of the run along ordinals that has this number in the state at its end."""
        return run_of(self.view, self.orbits, path).names[rebec] if self.orbits else rebec

    def deed(self, time: int, before: State, step: Step) -> Deed:
        """What happens in a step, without what it changes."""
        action, result = step.action, step.result
        outcome = self._outcome(before, action) if before and action.actor != TIME else None
        message = self._served(before, action)
        failed = self.failure(result, before, action, time) if isinstance(result, Failure) else None
        return Deed(
            _kind(before, action),
            self._rebec(action.actor),
            message and self.message(message, action.actor, time),
            self._chosen(outcome, action),
            failed,
        )

    def step(self, number: int, time: int, before: State, step: Step) -> TraceStep:
        """One step, taken at a time since the start in a state (before the first one: ())."""
        action, result = step.action, step.result
        failed = isinstance(result, Failure)
        after: State = before if isinstance(result, Failure) else result
        until = time if failed else time + step.time
        outcome = self._outcome(before, action) if before and action.actor != TIME else None
        message = self._served(before, action)
        return TraceStep(
            number,
            _kind(before, action),
            time,
            until,
            self._rebec(action.actor),
            message and self.message(message, action.actor, time),
            self._chosen(outcome, action),
            self._sent(outcome, step, action.actor, time),
            self._changes(before, after),
            self._line(before, action, message),
            self.state(after, until),
            action,
            self.failure(result, before, action, time) if isinstance(result, Failure) else None,
        )

    def _outcome(self, before: State, action: Action) -> Outcome:
        outcomes = self.view.actors[action.actor].outcomes(before[action.actor])
        return next(
            o
            for o in outcomes
            if o.slot == action.slot and o.choices[: len(action.choices)] == action.choices
        )

    # --- parts of a step

    def _rebec(self, index: int) -> str:
        return self.view.program.rebecs[index].name if index >= 0 else ""

    def _served(self, before: State, action: Action) -> Message | None:
        if not before or action.actor == TIME:
            return None
        local = before[action.actor]
        message = local.bag[action.slot] if action.slot >= 0 else None
        if message is None and local.point is not None:
            message = local.point.message
        return message if message is not None and message.server >= 0 else None

    def _chosen(self, outcome: Outcome | None, action: Action) -> tuple[str, ...]:
        if outcome is None:
            return ()
        code = self.view.program.code
        places = zip(outcome.picked, action.choices, strict=False)
        return tuple(
            self._value(code[pc].constants[choice], KINDS[code[pc].a]) for pc, choice in places
        )

    def _sent(
        self, outcome: Outcome | None, step: Step, actor: int, time: int
    ) -> tuple[ShownMessage, ...]:
        if outcome is None:
            return ()
        sends = outcome.sends
        if isinstance(step.result, Failure):
            sends = _until(sends, step.result)
        return tuple(self.message(s.message, s.receiver, time) for s in sends)

    def _changes(self, before: State, after: State) -> tuple[Change, ...]:
        changes = []
        for rebec, old, new in zip(self.view.program.rebecs, before, after, strict=False):
            if old.variables == new.variables:
                continue
            for slot in rebec.state:
                for cell, name in _cells(slot):
                    values = old.variables[cell], new.variables[cell]
                    if values[0] != values[1]:
                        told = (self._value(v, slot.kind) for v in values)
                        changes.append(Change(rebec.name, name, *told))
        return tuple(changes)

    def _line(self, before: State, action: Action, message: Message | None) -> int:
        if not before or action.actor == TIME:
            return 0
        program, point = self.view.program, before[action.actor].point
        if action.slot < 0 and point is not None:
            return self.line(program.spans[point.frames[-1].pc - 1])
        assert message is not None
        return self.line(program.servers[message.server].span)

    def line(self, span: Span) -> int:
        """The line of the model where a place begins."""
        return self.source.position(span.start).line

    def _value(self, cell: Cell, kind: Kind) -> str:
        if kind == "rebec":
            return self._rebec(int(cell)) or "null"
        return shown(cell, kind)

    # --- states

    def state(self, state: State, time: int) -> tuple[ShownRebec, ...]:
        """All rebecs in a state that is reached at a time since the start."""
        return tuple(self._shown(index, local, time) for index, local in enumerate(state))

    def _shown(self, index: int, local: Local, time: int) -> ShownRebec:
        rebec = self.view.program.rebecs[index]
        variables = tuple(
            (name, self._value(local.variables[cell], slot.kind))
            for slot in rebec.state
            for cell, name in _cells(slot)
        )
        line = None
        if local.point is not None:
            line = self.line(self.view.program.spans[local.point.frames[-1].pc - 1])
        busy = time + local.busy if local.busy or local.point else None
        bag = tuple(self.message(m, index, time) for m in local.bag)
        return ShownRebec(rebec.name, variables, bag, busy, line)

    def message(self, message: Message, receiver: int, time: int) -> ShownMessage:
        """A message whose times count from `time`."""
        program = self.view.program
        server = program.servers[message.server]
        values: list[tuple[str, str]] = []
        for slot in program.bodies[server.body].parameters:
            values += [
                (name, self._value(message.arguments[cell], slot.kind))
                for cell, name in _cells(slot)
            ]
        due = None if message.deadline == NO_DEADLINE else time + message.deadline
        arrival = 0 if self.view.semantics == "core" else time + message.arrival
        sender, to = self._rebec(message.sender), self._rebec(receiver)
        return ShownMessage(server.name, tuple(values), sender, arrival, due, to)

    # --- failures

    def failure(self, failure: Failure, before: State, action: Action, time: int) -> str:
        """What went wrong, as a sentence without its end."""
        program = self.view.program
        body = program.body_at(failure.pc).name
        rebec = self._rebec(failure.rebec)
        match failure.kind:
            case "deadline":
                message = self._served(before, action)
                assert message is not None
                due = time + message.deadline
                return f"{rebec} takes {body} at {time}, but it was due by {due}"
            case "overflow":
                to = program.rebecs[failure.rebec]
                sent = program.servers[to.dispatch[program.code[failure.pc].a]].name
                room = f"it has room for {to.capacity}"
                return f"the bag of {rebec} has no place for another message, {sent} ({room})"
            case "assertion":
                said = f': "{failure.text}"' if failure.text else ""
                return f"an assertion fails in {body}{said}"
            case "index":
                return f"an index is outside of its array in {body}"
            case "division":
                return f"a division by zero in {body}"
            case "null":
                return f"a message goes to null, or to a rebec that does not know it, in {body}"
            case "time":
                return f"after or delay is negative in {body}"


def _kind(before: State, action: Action) -> str:
    if not before:
        return "start"
    if action.actor == TIME:
        return "time"
    return "take" if action.slot >= 0 else "resume"


def _until(sends: tuple[Sent, ...], failure: Failure) -> tuple[Sent, ...]:
    """What went out before the step failed."""
    for position, sent in enumerate(sends):
        if failure.kind == "overflow" and (sent.pc, sent.receiver) == (failure.pc, failure.rebec):
            return sends[:position]
    return sends


def _cells(slot: Slot) -> list[tuple[int, str]]:
    """The cells of a variable with their names: `a`, or `a[0]`, `a[1]`, ..."""
    if not slot.type.dimensions:
        return [(slot.offset, slot.name)]
    indices = product(*(range(n) for n in slot.type.dimensions))
    return [
        (slot.offset + i, slot.name + "".join(f"[{n}]" for n in index))
        for i, index in enumerate(indices)
    ]
