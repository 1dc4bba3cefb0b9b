"""Which change of a recording makes what follows a run of the model again.

At the message itself a late one, a lost one and a repeated one look alike; in what comes after it
they do not. So each is undone in a copy of the next messages, and the search goes on in that: the
change with which all of it fits is the cause. It is the optimal alignment of conformance checking
(van der Aalst, Adriansyah, van Dongen: "Replaying history on process models for conformance
checking and performance analysis", 2012), with the faults of channels as moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import inf, isfinite
from typing import NamedTuple

from rebsync.checker.endless import EndlessBody
from rebsync.checker.program import Cell
from rebsync.conform.components.bodies import SentMessage
from rebsync.conform.components.component import Component, Output
from rebsync.conform.components.hypotheses import Candidate, Hypothesis
from rebsync.conform.components.inclusion import InclusionSearch
from rebsync.conform.components.lost_inputs import LostInput, lost_input
from rebsync.conform.conformance import Kind

_AHEAD = 8  # messages of each topic that have to fit after a change
_MOST_AHEAD = 400  # where other topics are quicker
_STATES = 500  # possible ones at a time in what follows a change
_CHANGES = 2  # so many together are tried
_KEPT = 4  # changes that came furthest, after each of which another one is tried
_PREFERRED: tuple[Kind, ...] = (
    "lost message", "late", "early", "swapped", "repeated", "wrong value", "unexpected",
)  # fmt: skip


class Expected(NamedTuple):
    """A message that the model publishes next, on which topic, by which server.

    It is `due` when its cause was, and comes between `low` and `high`; in seconds.
    """

    low: float
    due: float
    high: float
    topic: int
    sent: SentMessage
    server: int


class ChannelFault(NamedTuple):
    """A fault that is undone: its kind, and the message that is recorded, or published, or both."""

    kind: Kind
    topic: int
    recorded: Output | None
    expected: Expected | None


class _Repaired(NamedTuple):
    """The next messages of the topics after some changes: they fit up to some states, or all."""

    changes: tuple[ChannelFault, ...]
    outputs: tuple[Sequence[Output], ...]
    ends: Sequence[Hypothesis]
    fits: bool = False

    @property
    def cause(self) -> ChannelFault:
        """What the changes say together."""
        match self.changes:
            case (ChannelFault("lost message"), ChannelFault("unexpected" | "repeated")) if (
                self._is_one()
            ):
                first, other = self.changes
                return first._replace(kind="late", recorded=other.recorded)
            case (ChannelFault("unexpected" | "repeated"), ChannelFault("lost message")) if (
                self._is_one()
            ):
                first, other = self.changes
                return first._replace(kind="early", expected=other.expected)
            case (ChannelFault("wrong value"), ChannelFault("wrong value")) if self._is_one():
                return self.changes[0]._replace(kind="swapped")
            case _:
                return self.changes[0]

    def _is_one(self) -> bool:
        """Whether what is recorded in one change is what is published in the other."""
        one, other = self.changes
        pairs = ((one.recorded, other.expected), (other.recorded, one.expected))
        both = [(r.cells, e.sent.cells) for r, e in pairs if r is not None and e is not None]
        return one.topic == other.topic and bool(both) and all(a == b for a, b in both)

    @property
    def reached(self) -> float:
        """The latest time, in seconds, up to which they fit."""
        return inf if self.fits else max((end.low for end in self.ends), default=-inf)


def expected(search: InclusionSearch, before: Hypothesis) -> Iterator[Expected]:
    """What the model publishes next in a state."""
    component = search.component
    unit = component.timing.unit
    candidates = search.candidates(before) or _overdue(before)
    try:
        for candidate in candidates:
            for run in search.runs(before, candidate):
                for sent in run.published:
                    topic = component.by_server.get(sent.server)
                    if topic is not None:
                        elapsed = sent.after * unit
                        low, high = candidate.low + elapsed, candidate.high + elapsed
                        due = max(min(low + component.timing.slack, high), low)
                        yield Expected(low, due, high, topic, sent, candidate.server)
    except EndlessBody:
        return


def _overdue(before: Hypothesis) -> list[Candidate]:
    """What should have been served, and was not in time."""
    due = sorted(before.pending, key=lambda p: p.high)[:1]
    return [Candidate(p.server, p.cells, p.low, p.high, p) for p in due]


def by_time(each: Expected) -> tuple[float, float, float, int, tuple[Cell, ...], int, int]:
    """A key for sorting: what is published first comes first."""
    low, due, high, topic, sent, server = each
    return low, due, high, topic, sent.cells, sent.after, server


class Alignment:
    """The messages after a place that no run gets past; `last` are the states that got there."""

    def __init__(self, search: InclusionSearch, last: Sequence[Hypothesis]) -> None:
        self._search = search
        component, matched = search.component, last[0].matched
        self._horizon = _horizon(component, matched)
        before = [max(number - 1, 0) for number in matched]  # whether there was one counts
        outputs = tuple(
            [each for each in all_[n : n + _MOST_AHEAD] if each.stamp <= self._horizon]
            for n, all_ in zip(before, component.outputs, strict=True)
        )
        own = tuple(number - n for number, n in zip(matched, before, strict=True))
        self._begin = _Repaired((), outputs, [each._replace(matched=own) for each in last])

    def cause(self) -> ChannelFault | LostInput | None:
        """The change after which what follows fits, or fits for longest.

        An input is looked for where no messages that the node publishes are.
        None: no change helps, or nothing follows, and the model publishes more than once.
        """
        is_over = not any(map(self._left, range(len(self._begin.outputs))))
        tried: list[_Repaired] = [self._begin]
        for _ in range(1 if is_over else _CHANGES):
            best = sorted(tried, key=lambda t: -t.reached)[:_KEPT]
            tried = [
                self._tried(each, *changed) for each in best for changed in self._changed(each)
            ]
            if any(each.fits for each in tried):
                break
        else:
            if is_over:
                return None
            lost = self._lost_input()
            if lost is not None:
                return lost

        def rank(repaired: _Repaired) -> tuple[float, int]:
            return -self._moment(repaired.reached), _PREFERRED.index(repaired.cause.kind)

        found = min(tried, key=rank, default=None)
        return found.cause if found is not None and not self._is_silent(found) else None

    def _is_silent(self, repaired: _Repaired) -> bool:
        """Whether a message is put in, after which the model goes on, and the node does not."""
        each = repaired.cause.expected
        if repaired.fits or repaired.cause.kind != "lost message" or each is None:
            return False
        until = each.high + self._search.component.timing.slack
        return all(not all_ or all_[-1].stamp <= until for all_ in self._begin.outputs)

    def _lost_input(self) -> LostInput | None:
        search = self._on(self._begin.outputs)
        matched = self._begin.ends[0].matched
        both = zip(self._begin.outputs, matched, strict=True)
        next_ = [outputs[number].stamp for outputs, number in both if number < len(outputs)]
        return lost_input(search, self._begin.ends, min(next_))

    def _moment(self, time: float) -> float:
        """The same for times that differ by less than things may be late."""
        slack = self._search.component.timing.slack
        return time // slack if slack and isfinite(time) else time

    def _left(self, topic: int) -> int:
        """The number of messages that follow on a topic."""
        return len(self._begin.outputs[topic]) - self._begin.ends[0].matched[topic]

    def _on(self, outputs: tuple[Sequence[Output], ...]) -> InclusionSearch:
        component = self._search.component
        timing = replace(component.timing, end=self._horizon)
        window = replace(component, outputs=outputs, timing=timing)
        return InclusionSearch(window, _STATES, self._search.served_before)

    def _tried(
        self, before: _Repaired, change: ChannelFault, outputs: tuple[Sequence[Output], ...]
    ) -> _Repaired:
        found = self._on(outputs).run(before.ends)
        return _Repaired(
            (*before.changes, change), outputs, found.furthest, found.verdict == "fits"
        )

    # --- changes

    def _changed(
        self, repaired: _Repaired
    ) -> Iterator[tuple[ChannelFault, tuple[Sequence[Output], ...]]]:
        """The changes of what comes next, each once, with the messages after it."""
        search, seen = self._on(repaired.outputs), set[object]()
        for end in repaired.ends:
            for change, topic_after in self._changes(search, end):
                outputs = repaired.outputs
                after = (*outputs[: change.topic], topic_after, *outputs[change.topic + 1 :])
                each = change.expected
                when = (each.sent.cells, self._moment(each.due)) if each is not None else ()
                key = change.kind, change.topic, change.recorded, when
                if key not in seen:
                    seen.add(key)
                    yield change, after

    def _changes(
        self, search: InclusionSearch, end: Hypothesis
    ) -> Iterator[tuple[ChannelFault, Sequence[Output]]]:
        outputs = search.component.outputs
        for each in sorted(set(expected(search, end)), key=by_time):
            number = end.matched[each.topic]
            before, after = outputs[each.topic][:number], outputs[each.topic][number:]
            for change, changed in self._to(search, each, after):
                yield change, [*before, *changed]
        for topic, number in enumerate(end.matched):
            before, after = outputs[topic][:number], outputs[topic][number:]
            if after:
                is_again = bool(before) and before[-1].cells == after[0].cells
                kind: Kind = "repeated" if is_again else "unexpected"
                yield ChannelFault(kind, topic, after[0], None), [*before, *after[1:]]

    def _to(
        self, search: InclusionSearch, each: Expected, after: Sequence[Output]
    ) -> Iterator[tuple[ChannelFault, list[Output]]]:
        """The changes that make the next message of a topic the one that is expected."""
        topic, cells = each.topic, each.sent.cells
        missing = Output(each.due, cells, (), -1, -1)
        yield ChannelFault("lost message", topic, None, each), [missing, *after]
        if not after:
            return
        first, *rest = after
        if search.is_output(first, each.sent):
            kind: Kind = "early" if first.stamp < each.low else "late"
            yield ChannelFault(kind, topic, first, each), [first._replace(stamp=each.due), *rest]
        else:
            yield (
                ChannelFault("wrong value", topic, first, each),
                [first._replace(cells=cells), *rest],
            )


def _horizon(component: Component, matched: Sequence[int]) -> float:
    """The time up to which what follows is looked at."""
    ends, most = [], component.timing.end
    for number, outputs in zip(matched, component.outputs, strict=True):
        if number < len(outputs):
            ends.append(outputs[min(number + _AHEAD, len(outputs) - 1)].stamp)
        if number + _MOST_AHEAD < len(outputs):
            most = min(most, outputs[number + _MOST_AHEAD - 2].stamp)
    is_whole = all(n + _AHEAD >= len(o) for n, o in zip(matched, component.outputs, strict=True))
    return most if is_whole else min(most, max(ends))
