"""The ways of messages through a run: where each is sent, and where it is taken."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import replace

from rebsync.checker.trace import ShownMessage, Trace, TraceStep
from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Flight:
    """A message on its way: `sent` and `taken` are positions in the run's steps.

    `place` counts the messages of the sending step; `taken` is None while the message waits.
    """

    message: ShownMessage
    sent: int
    place: int
    taken: int | None = None


def departures(step: TraceStep) -> tuple[ShownMessage, ...]:
    """What a step sends; for the start, what is in the bags after the constructors."""
    if step.kind != "start" or step.sent:
        return step.sent
    return tuple(replace(m, receiver=rebec.name) for rebec in step.rebecs for m in rebec.bag)


def flights(trace: Trace) -> tuple[Flight, ...]:
    """All messages in the order in which they are sent; of equal ones the first goes first."""
    waiting: dict[ShownMessage, list[int]] = defaultdict(list)
    found: list[Flight] = []
    for position, step in enumerate(trace.steps):
        if step.kind == "take" and step.message is not None:
            sent = waiting[_key(step.message, step.rebec)]
            if sent:
                number = sent.pop(0)
                found[number] = replace(found[number], taken=position)
        for place, message in enumerate(departures(step)):
            waiting[_key(message, message.receiver)].append(len(found))
            found.append(Flight(message, position, place))
    return tuple(found)


def _key(message: ShownMessage, receiver: str) -> ShownMessage:
    """The message with its receiver, which a message in a bag need not say."""
    return replace(message, receiver=receiver)


def lanes(spans: Iterable[tuple[float, float]]) -> list[int]:
    """For each span a lane in which it meets no other; the first lane that is free, in order."""
    ends: list[float] = []
    given: list[int] = []
    for start, end in spans:
        free = next((i for i, last in enumerate(ends) if last < start), len(ends))
        if free == len(ends):
            ends.append(end)
        ends[free] = end
        given.append(free)
    return given
