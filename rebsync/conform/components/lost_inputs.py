"""Which input a node has not got, or got and it was not recorded, if what it publishes says so.

These are the moves of an alignment on what the node receives: one is put in before the message that
no run explains, or may be missed; the change is right if all that follows fits.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice, takewhile
from typing import NamedTuple

from rebsync.conform.components.component import (
    CONNECTS,
    UNORDERED,
    Component,
    Input,
)
from rebsync.conform.components.hypotheses import Hypothesis
from rebsync.conform.components.inclusion import InclusionSearch
from rebsync.conform.components.spool import Spool

_VALUES = 8  # different inputs that may have come
_LOOKED_AT = 500  # inputs among which these are looked for
_STATES = 500  # possible ones at a time in what follows a change


class LostInput(NamedTuple):
    """An input that `is_recorded` and did not come, or came and is not recorded."""

    input: Input
    is_recorded: bool


def lost_input(
    search: InclusionSearch, ends: Sequence[Hypothesis], stamp: float
) -> LostInput | None:
    """The input with which, or without which, all messages from a stamp on fit; None: no such.

    `search` is one up to the end of what is looked at, and `ends` are the states it begins in.
    """
    component = search.component
    first = min(end.base for end in ends)
    until = component.timing.end + component.timing.slack + CONNECTS
    after = takewhile(lambda each: each.stamp <= until, component.inputs.since(first))
    inputs, shifted = list(after), [_shifted(end, first) for end in ends]
    for fault, changed in _changes(component, inputs, shifted, stamp):
        window = replace(component, inputs=Spool(changed))
        again = InclusionSearch(window, _STATES, search.served_before)
        if again.run(shifted).verdict == "fits":
            return fault
    return None


def _shifted(end: Hypothesis, first: int) -> Hypothesis:
    """A state with the numbers of the inputs from one on."""
    return end._replace(base=end.base - first, taken=frozenset(n - first for n in end.taken))


def _changes(
    component: Component, inputs: list[Input], ends: Sequence[Hypothesis], stamp: float
) -> Iterator[tuple[LostInput, list[Input]]]:
    for number, each in enumerate(inputs):
        if each.stamp <= stamp + component.timing.slack:
            missing = each._replace(may_drop=True)
            yield LostInput(each, True), [*inputs[:number], missing, *inputs[number + 1 :]]
    place = max(max((end.base, *(n + 1 for n in end.taken))) for end in ends)
    for server, cells in _values(component):
        earliest = stamp - component.timing.slack
        more = Input(stamp, server, cells, UNORDERED, False, earliest, False)
        yield LostInput(more, False), [*inputs[:place], more, *inputs[place:]]


def _values(component: Component) -> list[tuple[int, tuple[int, ...]]]:
    """Inputs as they were recorded."""
    found = dict.fromkeys((i.server, i.cells) for i in islice(component.inputs, _LOOKED_AT))
    return list(islice(found, _VALUES))
