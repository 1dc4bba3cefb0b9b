"""Formulas with bounds of time, and all but `X`, in the real time of recorded topics.

What was published or got last is known but for the time in which a message may have been on its
way; then any of the values counts that may have been the last. The run goes on after the recording.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field
from itertools import groupby, islice, product
from math import inf

from rebsync.checker.formulas import Formula
from rebsync.conform.components.dense_formulas import (
    SignalEvaluator,
    conditions_of,
    is_true,
    says_always,
)
from rebsync.conform.components.signals import Signal
from rebsync.conform.properties import RunVerdict, greatest_bound
from rebsync.records import dataclass

MOST = 100_000  # changes of values on a topic
_TOGETHER = 256  # states that may be at one time

Values = tuple[int, ...]
Truth = Callable[[Mapping[int, Values]], Mapping[int, bool]]
"""What predicates are in a state: what was last on each topic, by its number."""


@dataclass(slots=True)
class TopicChanges:
    """The values of a topic, each with the stamp since when it is the last; `is_got`: messages
    are seen by who gets them, else by who publishes them."""

    is_got: bool
    changes: list[tuple[float, Values]] = field(default_factory=list)

    def see(self, stamp: float, values: Values) -> None:
        """The next message."""
        if not self.changes or values != self.changes[-1][1]:
            before = self.changes[-1][0] if self.changes else -inf
            self.changes.append((max(stamp, before), values))


@dataclass(frozen=True, slots=True)
class DenseAnswer:
    """An answer, since when, by how many steps all bounds were met, and whether it holds so far."""

    verdict: RunVerdict
    time: float
    margin: int | None
    is_fulfilled: bool


@dataclass(frozen=True, slots=True)
class DenseRun:
    """What was recorded up to `end`, of messages that may be late by `slack`."""

    topics: tuple[TopicChanges, ...]
    truth: Truth
    end: float
    slack: float
    known: dict[tuple[Values | None, ...], Mapping[int, bool]] = field(default_factory=dict)

    def evaluated(self, formula: Formula, begin: float, unit: float, step: float) -> DenseAnswer:
        """A formula whose bounds are in units of `unit` seconds. The margin is in steps.

        Whatever the time before the recording in which the run began has to be the same answer.
        """
        late = SignalEvaluator(self.signals(formula, self.slack, False), unit)
        whole = late.signal(formula)
        margin = self._margin(formula, begin, unit, step)
        for verdict, spans in (("violated", whole.false), ("satisfied", whole.true)):
            if spans and spans[0][0] == -inf:
                since = late.since(formula, verdict == "violated")
                bounds = (greatest_bound(formula) or 0) * unit if since < inf else 0.0
                at = max(since, begin) + bounds if since < inf else begin
                return DenseAnswer(verdict, at, margin, False)  # type: ignore[arg-type]
        if not says_always(formula):
            return DenseAnswer("undetermined", 0.0, margin, False)
        still = SignalEvaluator(self.signals(formula, 0.0, True), unit).signal(formula)
        return DenseAnswer("open", 0.0, margin, not still.false or still.false[0][0] > -inf)

    def _margin(self, formula: Formula, begin: float, unit: float, step: float) -> int | None:
        """By how many steps all bounds can be stricter with the formula not violated, by the stamps
        as they are. None: there are none, or none is ever asked for."""
        most = greatest_bound(formula)
        if most is None:
            return None
        signals = self.signals(formula, 0.0, False)
        top = round((most * unit + self.end - begin) / step) + 1
        if not self._holds(signals, formula, unit, -top * step):
            return None
        if self._holds(signals, formula, unit, top * step):
            return None
        low = bisect_left(
            range(-top, top), True, key=lambda m: not self._holds(signals, formula, unit, m * step)
        )
        return low - top - 1

    def _holds(
        self, signals: Mapping[Formula, Signal], formula: Formula, unit: float, margin: float
    ) -> bool:
        false = SignalEvaluator(signals, unit, margin).signal(formula).false
        return not false or false[0][0] > -inf

    def signals(self, formula: Formula, slack: float, goes_on: bool) -> dict[Formula, Signal]:
        """The conditions in a formula. `goes_on`: nothing more is ever published."""
        conditions = tuple(dict.fromkeys(conditions_of(formula)))
        true: dict[Formula, list[tuple[float, float]]] = {each: [] for each in conditions}
        false: dict[Formula, list[tuple[float, float]]] = {each: [] for each in conditions}
        for start, end, joins, truths in self._pieces(slack, goes_on):
            for condition in conditions:
                values = {is_true(condition, truth) for truth in truths}
                if len(values) == 2:
                    continue
                spans = (true if True in values else false)[condition]
                if joins and spans and spans[-1][1] == start:
                    spans[-1] = spans[-1][0], end
                else:
                    spans.append((start, end))
        return {c: Signal(tuple(true[c]), tuple(false[c])) for c in conditions}

    def _pieces(
        self, slack: float, goes_on: bool
    ) -> Iterator[tuple[float, float, bool, list[Mapping[int, bool]]]]:
        """Times between which the states that may be are the same, with what is true in each.

        The third says whether, at the beginning, only states may be that also may be just before
        or after it: one topic changed there.
        """
        possible = [dict[Values | None, int]({None: 1}) for _ in self.topics]
        start, end, joins = -inf, inf if goes_on else self.end - slack, False
        for time, group in groupby(self._moves(slack), lambda move: move[0]):
            if time >= end:
                break
            yield from ((start, time, joins, truths) for truths in self._truths(possible))
            moves = list(group)
            start, joins = time, len({topic for _, topic, _, _ in moves}) == 1
            for _, topic, values, change in moves:
                possible[topic][values] = possible[topic].get(values, 0) + change
                if not possible[topic][values]:
                    del possible[topic][values]
        yield from ((start, end, joins, truths) for truths in self._truths(possible))

    def _truths(
        self, possible: Sequence[Mapping[Values | None, int]]
    ) -> Iterator[list[Mapping[int, bool]]]:
        """What is true in the states that may be; nothing where one may be before all messages."""
        states = list(islice(product(*possible), _TOGETHER + 1))
        if len(states) <= _TOGETHER and not any(None in values for values in possible):
            yield [self._truth(state) for state in states]

    def _truth(self, state: tuple[Values | None, ...]) -> Mapping[int, bool]:
        found = self.known.get(state)
        if found is None:
            if len(self.known) >= MOST:
                self.known.clear()
            values = {n: v for n, v in enumerate(state) if v is not None}
            found = self.known[state] = self.truth(values)
        return found

    def _moves(self, slack: float) -> list[tuple[float, int, Values | None, int]]:
        """When values begin to be possible, and cease to."""
        found: list[tuple[float, int, Values | None, int]] = []
        for number, topic in enumerate(self.topics):
            before: Values | None = None
            for stamp, values in topic.changes:
                found.append((stamp - slack, number, values, 1))
                found.append((stamp + slack if topic.is_got else stamp, number, before, -1))
                before = values
        return sorted(found, key=lambda move: move[0])
