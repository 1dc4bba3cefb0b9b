"""Recordings of runs whose bodies take longer than their model says, by amounts that are known."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from rebsync.calibration.calibrate import Calibration, calibrate
from rebsync.calibration.measure import measure
from rebsync.checker.course import Delayed
from rebsync.checker.lowering import lower
from rebsync.checker.state import Message, State
from rebsync.checker.steps import TIME, Action, Failure
from rebsync.checker.views import Exact
from rebsync.config import Config
from rebsync.conform.matching import Subject
from rebsync.conform.observable import Observable
from rebsync.conform.recording import Announced, Event, Place, Served
from rebsync.diagnostics import Severity
from rebsync.forward.view import view
from rebsync.grammars.parser import parse_model
from rebsync.model import Model
from rebsync.source import Source
from rebsync.static import analyse
from tests.conform.simulated import Recorded

EXAMPLES = Path(__file__).parents[2] / "examples"
ZERO = 1000.0  # s, of the recording's clock
EPSILON = 0.01  # units that a state message is under way, at most


@dataclass(frozen=True)
class Measurable:
    """A model that recordings are compared with."""

    model: Model
    subject: Subject


def measurable(text: str, time_unit: float = 1.0, slack: float = 0.5) -> Measurable:
    """A model by its text."""
    source = Source("model.rebeca", text)
    parsed = parse_model(source)
    analysis = analyse(parsed.model)
    errors = [d for d in analysis.diagnostics if d.severity is Severity.ERROR]
    assert parsed.ok and not errors, errors
    config = Config(time_unit=time_unit, slack=slack)
    package, _ = view(parsed.model, analysis, config, "model")
    program, _ = lower(analysis)
    return Measurable(parsed.model, Subject(source, program, Observable.of(program, package)))


def calibrated(given: Measurable, recorded: Recorded) -> Calibration:
    """What a recording asks of a model."""
    times = measure(given.subject, given.model, recorded)
    return calibrate(given.subject.source, given.model, times)


Extra = Callable[[str, Random], float]
"""By how many units a body (`Class.server`) takes longer, each time that it runs a delay."""


@dataclass
class Run:
    """A run with a clock of its own: `took` has what each delay really took, by its line."""

    given: Measurable
    extra: Extra
    random: Random
    shown: list[Served] = field(default_factory=list)
    took: dict[int, list[float]] = field(default_factory=lambda: defaultdict(list))
    free: dict[int, float] = field(default_factory=lambda: defaultdict(float))
    stamps: dict[int, float] = field(default_factory=lambda: defaultdict(float))
    real: dict[int, float] = field(default_factory=dict)
    starts: dict[int, int] = field(default_factory=dict)
    sent: dict[tuple[int, Message], deque[float]] = field(
        default_factory=lambda: defaultdict(deque)
    )

    def make(self, steps: int) -> Recorded:
        """Makes steps by chance, and gives the recording of them, by stamps."""
        program = self.given.subject.program
        exact = Exact(program)
        begun = [s.result for s in exact.initial_states() if not isinstance(s.result, Failure)]
        state, time = self.random.choice(begun), 0
        for rebec, local in enumerate(state):
            if local.point is None:
                self._show(rebec, state, None, 0, 0, 0.0)
        for _ in range(steps):
            possible = [s for s in exact.steps(state) if not isinstance(s.result, Failure)]
            if not possible:
                break
            step = self.random.choice(possible)
            assert not isinstance(step.result, Failure)
            if step.action.actor == TIME:
                time += step.time
            else:
                self._act(exact, state, step.action, step.result, time)
            state = step.result
        unit = self.given.subject.time_unit
        announced: list[Event] = [Announced("a", ZERO, ZERO - 1, Place(0, 0))]
        stamped = [s._replace(stamp=ZERO + s.stamp * unit) for s in self.shown]
        return Recorded((*announced, *sorted(stamped, key=lambda s: s.stamp)))

    def _act(self, exact: Exact, state: State, action: Action, after: State, time: int) -> None:
        rebec = action.actor
        program = exact.program
        point = state[rebec].point
        message = state[rebec].bag[action.slot] if point is None else point.message
        if point is None:
            self.starts[rebec] = time
            waiting = self.sent[rebec, self._key(message, time)]
            sent = waiting.popleft() if waiting else 0.0
            self.real[rebec] = max(float(time), self.free[rebec], sent)
        else:
            self.real[rebec] = max(float(time), self.real[rebec])
        outcome = next(
            o
            for o in exact.actors[rebec].outcomes(state[rebec])
            if (o.slot, o.choices) == (action.slot, action.choices)
        )
        for send in outcome.sends:
            if send.receiver >= 0:
                key = send.receiver, self._key(send.message, time)
                self.sent[key].append(self.real[rebec])
        for event in outcome.course:
            if isinstance(event, Delayed):
                name = "constructor"
                if message.server >= 0:
                    server = program.servers[message.server]
                    name = f"{server.class_name}.{server.name}"
                took = event.time + self.extra(name, self.random)
                line = self.given.subject.source.position(program.spans[event.pc].start).line
                self.took[line].append(took)
                self.real[rebec] += took
        if after[rebec].point is None:
            served = message if message.server >= 0 else None
            self.free[rebec] = self.real[rebec]
            self._show(rebec, after, served, self.starts.get(rebec, 0), time, self.real[rebec])

    def _key(self, message: Message, time: int) -> Message:
        return message._replace(arrival=message.arrival + time, deadline=0)

    def _show(
        self, rebec: int, state: State, message: Message | None, start: int, now: int, real: float
    ) -> None:
        program, observable = self.given.subject.program, self.given.subject.observable
        server, arguments, arrival = "constructor", "", 0
        if message is not None:
            server = program.servers[message.server].name
            arguments = observable.arguments(message.server, message.arguments)
            arrival = now + message.arrival
        # What one node publishes comes in its order.
        stamp = max(real + self.random.random() * EPSILON, self.stamps[rebec])
        self.stamps[rebec] = stamp
        cells = state[rebec].variables
        place = Place(0, len(self.shown))
        self.shown.append(
            Served(rebec, server, arguments, arrival, start, now, cells, stamp, place)
        )
