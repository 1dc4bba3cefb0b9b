"""What a component's published messages took, by one run of its model that fits."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from itertools import pairwise

from rebsync.roundtrip.conform.components.component import Component
from rebsync.roundtrip.conform.components.hypotheses import Hypothesis
from rebsync.roundtrip.conform.conformance import TopicInterval


def intervals(component: Component, run: Sequence[Hypothesis]) -> tuple[TopicInterval, ...]:
    """The times from what a server got to what it published on a topic, and from one to the next.

    The first of servers of messages from outside ("delay"), the second of servers of messages that
    the rebec sends itself, such as timers ("period").
    """
    found: dict[tuple[str, str, str], array[float]] = {}
    last: dict[tuple[int, int], float] = {}
    for before, after in pairwise(run):
        inputs = [component.inputs[n] for n in _newly_taken(before, after)]
        changed = enumerate(zip(before.matched, after.matched, strict=True))
        for topic, stamp in (
            (k, component.outputs[k][was].stamp) for k, (was, now) in changed if now > was
        ):
            if after.last < 0 or (component.kept[topic] and not before.matched[topic]):
                continue
            name = component.program.servers[after.last].name
            if inputs:
                key = name, component.topics[topic], "delay"
                found.setdefault(key, array("d")).append(stamp - inputs[0].stamp)
                continue
            before_it = last.get((after.last, topic))
            if before_it is not None:
                key = name, component.topics[topic], "period"
                found.setdefault(key, array("d")).append(stamp - before_it)
            last[after.last, topic] = stamp
    return tuple(TopicInterval(component.name, *key, seconds) for key, seconds in found.items())


def _newly_taken(before: Hypothesis, after: Hypothesis) -> list[int]:
    """The inputs that are passed in a step."""
    advanced = {*range(before.base, after.base), *after.taken}
    return sorted(advanced - before.taken)
