"""A run of a component as people read it: what it served when, and what it published then."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from rebsync.checker.steps import Action
from rebsync.checker.trace import ShownMessage, ShownRebec, TraceStep
from rebsync.conform.components.component import Component
from rebsync.conform.components.environment import CLASS
from rebsync.conform.components.hypotheses import Hypothesis
from rebsync.conform.components.interface import shown

SHOWN = 40  # steps


def steps_of(
    component: Component, run: Sequence[Hypothesis], until: float
) -> tuple[TraceStep, ...]:
    """The last steps of a run up to a time in which something was published; times are those of
    the model."""
    found = deque(
        (
            step
            for before, after in pairwise(run)
            if before.matched != after.matched and after.last >= 0
            for step in _step(component, before, after)
            if step.time <= until
        ),
        maxlen=SHOWN,
    )
    return tuple(found)


def _step(component: Component, before: Hypothesis, after: Hypothesis) -> Iterator[TraceStep]:
    """What a rebec serves and publishes; then how that gets to the other end of its topics."""
    program = component.program
    outside = next(n for n, r in enumerate(program.rebecs) if r.class_name == CLASS)
    sent = [
        ShownMessage(
            component.topics[topic], (("", shown(program, number, output.cells)[1:-1]),),
            component.name, _time(component, output.stamp), None, program.rebecs[outside].name,
        )
        for number, topic in component.by_server.items()
        for output in component.outputs[topic][before.matched[topic] : after.matched[topic]]
    ]  # fmt: skip
    server, time = program.servers[after.last].name, max(_time(component, after.low), 0)
    message = ShownMessage(server, (), "", time, None, component.name)
    yield _taken(component, component.rebec, message, tuple(sent))
    for each in sent:
        yield _taken(component, outside, each, ())


def _taken(
    component: Component, rebec: int, message: ShownMessage, sent: tuple[ShownMessage, ...]
) -> TraceStep:
    lifelines = tuple(ShownRebec(info.name, (), ()) for info in component.program.rebecs)
    time, name = message.arrival, component.program.rebecs[rebec].name
    return TraceStep(
        0, "take", time, time, name, message, (), sent, (), 0, lifelines, Action(rebec)
    )


def _time(component: Component, stamp: float) -> int:
    return round((stamp - component.timing.begin) / component.timing.unit)


def merged(runs: Sequence[tuple[TraceStep, ...]]) -> tuple[TraceStep, ...]:
    """The last steps of several components, by time."""
    steps = sorted((step for run in runs for step in run), key=lambda step: step.time)[-SHOWN:]
    return tuple(replace(step, number=number) for number, step in enumerate(steps, 1))
