"""Runs that the checker makes, as recordings of generated nodes would tell them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

from rebsync.checker.lowering import lower
from rebsync.checker.program import Program
from rebsync.checker.state import Message, State
from rebsync.checker.steps import TIME, Failure
from rebsync.checker.views import Exact
from rebsync.config import Config
from rebsync.conform.observable import Observable
from rebsync.conform.recording import Event, Place, Served
from rebsync.diagnostics import Severity
from rebsync.forward.view import view
from rebsync.grammars.parser import parse_model
from rebsync.model import Model
from rebsync.source import Source
from rebsync.static import analyse


@dataclass(frozen=True, slots=True)
class Given:
    """A model made ready to run, and to be compared with."""

    program: Program
    observable: Observable


def given(text: str, name: str = "model.rebeca") -> Given:
    """A model by its text."""
    parsed = parse_model(Source(name, text))
    assert parsed.ok, parsed.diagnostics
    return of_model(parsed.model)


def of_model(model: Model) -> Given:
    """A model made ready."""
    analysis = analyse(model)
    errors = [d for d in analysis.diagnostics if d.severity is Severity.ERROR]
    assert not errors, errors
    program, _ = lower(analysis)
    package, _ = view(model, analysis, Config(), "model")
    return Given(program, Observable.of(program, package))


@dataclass(frozen=True, slots=True)
class Recorded:
    """Events that are there already."""

    all: tuple[Event, ...]
    paths: tuple[str, ...] = ("simulated",)

    def events(self, with_sent: bool = False) -> Iterator[Event]:
        return iter(self.all)


def simulate(given: Given, seed: int, most: int = 60, until: int = 10**9) -> list[Served]:
    """What a run by chance shows: each body when it ends. It stops before a step that fails."""
    random = Random(seed)
    exact = Exact(given.program)
    begun = [s.result for s in exact.initial_states() if not isinstance(s.result, Failure)]
    if not begun:
        return []
    state = random.choice(begun)
    time = 0
    starts = [0] * len(state)
    shown = [_served(given, i, state, None, 0, 0, n) for n, i in enumerate(_ended(state))]
    while len(shown) < most:
        steps = [s for s in exact.steps(state) if not isinstance(s.result, Failure)]
        if not steps:
            break
        step = random.choice(steps)
        assert not isinstance(step.result, Failure)
        if step.action.actor == TIME:
            time += step.time
            if time > until:
                break
        else:
            rebec = step.action.actor
            if step.action.slot >= 0:
                starts[rebec] = time
                message = state[rebec].bag[step.action.slot]
            else:
                point = state[rebec].point
                assert point is not None
                message = point.message
            if step.result[rebec].point is None:
                served = None if message.server < 0 else message
                number = len(shown)
                shown.append(
                    _served(given, rebec, step.result, served, starts[rebec], time, number)
                )
        state = step.result
    return shown


def _ended(state: State) -> list[int]:
    return [i for i, local in enumerate(state) if local.point is None]


def _served(
    given: Given,
    rebec: int,
    state: State,
    message: Message | None,
    start: int,
    time: int,
    number: int,
) -> Served:
    server, arguments, arrival = "constructor", "", 0
    if message is not None:
        server = given.program.servers[message.server].name
        arguments = given.observable.arguments(message.server, message.arguments)
        arrival = time + message.arrival
    cells = state[rebec].variables
    return Served(
        rebec, server, arguments, arrival, start, time, cells, float(time), Place(0, number)
    )
