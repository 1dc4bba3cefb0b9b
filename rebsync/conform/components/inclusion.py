"""A search for a run of one component that receives and publishes what was recorded.

A hypothesis is a state of the rebec with the messages that it has posted to itself. Clocks are
those of the recording, and no body is seen itself: so each has an interval of real time in which it
ran, from what it was caused by, give or take the slack. What it publishes narrows the interval. All
orders are tried that the intervals leave open, and all choices; what differs in nothing is one.
Errors of time do not add up: each body is counted from what caused it, and from what was recorded.
"""

from __future__ import annotations

import heapq
from collections import defaultdict
from collections.abc import Iterable, Sequence
from itertools import count
from math import inf
from operator import lt
from typing import Literal

from rebsync.checker.endless import EndlessBody
from rebsync.checker.steps import Failure
from rebsync.conform.components.bodies import BodyRun, SentMessage
from rebsync.conform.components.component import (
    CONNECTS,
    UNORDERED,
    Component,
    Input,
    Output,
)
from rebsync.conform.components.hypotheses import (
    Candidate,
    Hypothesis,
    Posted,
    advanced,
    missed,
)
from rebsync.conform.components.interface import is_same
from rebsync.conform.components.spool import Spool
from rebsync.records import dataclass

BEFORE = 60.0  # s before a recording in which nodes may have begun
_KEPT = 64  # hypotheses that came furthest: the first and the last ones

Fit = tuple[float, float, tuple[int, ...]]
"""When a body may have run, and how many outputs of each topic fit then."""


@dataclass(frozen=True, slots=True)
class Inclusion:
    """How a search ended. `raced`: bodies of two threads may have overlapped before.

    `furthest` are states by time, the first and the last ones of those that explain most outputs.
    """

    verdict: Literal["fits", "refused", "cut"]
    reason: str = ""
    furthest: tuple[Hypothesis, ...] = ()
    raced: bool = False
    failures: tuple[Failure, ...] = ()
    widest: int = 1
    last: Hypothesis | None = None  # of a run that fits


class InclusionSearch:
    """One search; with more than `limit` hypotheses at a time it is cut.

    Inputs up to `served_before` may have been served before the beginnings. `keeps`: the way to
    a hypothesis can be asked for.
    """

    def __init__(self, component: Component, limit: int, served_before: float = -inf) -> None:
        self.component = component
        self.limit = limit
        self.served_before = served_before
        self.raced = False
        self.keeps = False
        self._came_from: dict[Hypothesis, Hypothesis] = {}
        self._settled = Spool[Hypothesis]()  # the way up to where only one was possible
        self.failures: dict[Failure, None] = {}
        self._timing = component.timing
        self._ahead = max(component.timing.slack, CONNECTS)  # kept ones may come so much before
        self._received = len(component.inputs)
        self._recorded = tuple(map(len, component.outputs))
        # What caused a message just before the end may have been recorded after it, so not at all.
        until = self._timing.end - self._timing.slack
        self._caused = tuple(_until(outputs, until) for outputs in component.outputs)
        self._furthest: list[Hypothesis] = []
        self._explained = -1  # outputs, in each of these
        self._waiting: list[tuple[float, int, Hypothesis]] = []
        self._seen: defaultdict[float, set[Hypothesis]] = defaultdict(set)
        self._numbers = count()

    # --- beginnings

    def constructed(self) -> list[Hypothesis]:
        """The rebec as its constructor leaves it, at any time up to its first message."""
        nothing = tuple(0 for _ in self.component.outputs)
        low, high = self._timing.begin - BEFORE, self._timing.first
        before = Hypothesis(low, high, (-inf, -inf), (), (), 0, frozenset(), nothing)
        candidate = Candidate(-1, (), low, high)
        runs = self.component.bodies.constructed()
        return [after for run in runs for after in self._ran(before, candidate, run)]

    # --- the search

    def run(self, starts: Iterable[Hypothesis]) -> Inclusion:
        """Whether one of the beginnings leads to the end of the recording."""
        for each in starts:
            self._push(each)
        widest, before = 1, -inf
        fitting: Hypothesis | None = None
        while self._waiting:
            widest = max(widest, len(self._waiting))
            if len(self._waiting) > self.limit:
                reason = f"more than {self.limit} states of {self.component.name} are possible"
                return self._ended("cut", reason, widest)
            low, _, hypothesis = heapq.heappop(self._waiting)
            self._note(hypothesis)
            if low > before:
                self._seen.pop(before, None)
                before = low
            if self.keeps and not self._waiting:
                self.way_to(hypothesis)
                self._came_from = {}
            if self._is_complete(hypothesis, self._recorded):
                return self._ended("fits", "", widest, hypothesis)
            if self._is_complete(hypothesis, self._caused) and (
                fitting is None or sum(hypothesis.matched) > sum(fitting.matched)
            ):
                fitting = hypothesis
            try:
                after = self.successors(hypothesis)
            except EndlessBody as endless:
                body = self.component.program.body_at(endless.pc).name
                return self._ended("cut", f"a body of {body} does not end", widest)
            for each in after:
                self._push(each)
                if self.keeps and each != hypothesis:
                    self._came_from.setdefault(each, hypothesis)
        return self._ended("refused" if fitting is None else "fits", "", widest, fitting)

    def way_to(self, last: Hypothesis) -> Sequence[Hypothesis]:
        """The hypotheses up to one, as far as they are known; it is the last to be asked for."""
        way = [last]
        while way[-1] in self._came_from:
            way.append(self._came_from[way[-1]])
        way.reverse()
        if self._settled and self._settled[-1] != way[0]:
            return way
        for each in way[1 if self._settled else 0 :]:
            self._settled.append(each)
        return self._settled

    def _ended(
        self,
        verdict: Literal["fits", "refused", "cut"],
        reason: str,
        widest: int,
        last: Hypothesis | None = None,
    ) -> Inclusion:
        furthest, failures = tuple(self._furthest), tuple(self.failures)
        return Inclusion(verdict, reason, furthest, self.raced, failures, widest, last)

    def _push(self, hypothesis: Hypothesis) -> None:
        seen = self._seen[hypothesis.low]
        if hypothesis not in seen:
            seen.add(hypothesis)
            heapq.heappush(self._waiting, (hypothesis.low, next(self._numbers), hypothesis))

    def _note(self, hypothesis: Hypothesis) -> None:
        """Keeps a state if no other explains more outputs."""
        explained = sum(hypothesis.matched)
        if explained > self._explained:
            self._explained = explained
            self._furthest.clear()
        if explained == self._explained:
            self._furthest.append(hypothesis)
            if len(self._furthest) > _KEPT:
                del self._furthest[_KEPT // 2]

    def _is_complete(self, hypothesis: Hypothesis, outputs: tuple[int, ...]) -> bool:
        """Whether so many outputs are explained, and nothing was due before the end."""
        if any(map(lt, hypothesis.matched, outputs)):
            return False
        return self._latest(hypothesis) >= self._timing.end

    # --- steps

    def successors(self, before: Hypothesis) -> list[Hypothesis]:
        """What may happen next. EndlessBody: a body does not end."""
        found: list[Hypothesis] = []
        for candidate in self.candidates(before):
            if candidate.input is not None and self._may_miss(before, candidate.input):
                found.append(missed(before, candidate.number))
            for run in self.runs(before, candidate):
                found += self._ran(before, candidate, run)
        return found

    def runs(self, before: Hypothesis, candidate: Candidate) -> tuple[BodyRun, ...]:
        """The ways to serve a message."""
        return self.component.bodies.runs(before.variables, candidate.server, candidate.cells)

    def candidates(self, before: Hypothesis) -> list[Candidate]:
        """The messages that may be served next: none of the others would be too late then."""
        limit = min(self._latest(before), self._next_output(before))
        earliest, _, (free, _), _, pending, base, taken, _, _, _ = before
        begin, slack = max(earliest, free), self._timing.slack
        if limit < begin:
            return []
        found: list[Candidate] = []
        for each in pending:
            low = max(begin, each.low - slack)
            if low <= limit:
                found.append(Candidate(each.server, each.cells, low, limit, each))
        lanes: set[int] = set()
        for number, each_in in enumerate(self.component.inputs.since(base), base):
            stamp, server, cells, lane, _, first, _ = each_in
            if stamp - self._ahead > limit:
                break
            if number in taken or lane in lanes:
                continue
            if lane != UNORDERED:
                lanes.add(lane)
            if first <= limit:
                low = max(begin, first)
                found.append(Candidate(server, cells, low, limit, None, number, each_in))
        return found

    def _upper(self, before: Hypothesis, low: float, high: float) -> float:
        """The latest time at which something is served that is due in an interval."""
        busy = before.free[1]
        return (max(high, busy) if low - self._timing.slack <= busy else high) + self._timing.slack

    def _latest(self, before: Hypothesis) -> float:
        """The time up to which something has to be served; of inputs the first is due first."""
        latest = inf
        for each in before.pending:
            latest = min(latest, self._upper(before, each.low, each.high))
        if before.base < self._received:
            due = self._due(self.component.inputs[before.base])
            latest = min(latest, self._upper(before, due, due))
        return latest

    def _due(self, each: Input) -> float:
        """When an input comes at the latest; those that are kept may when the node connects."""
        return max(each.stamp, self._timing.first + CONNECTS) if each.is_kept else each.stamp

    def _next_output(self, before: Hypothesis) -> float:
        stamp = inf
        for topic, number in enumerate(before.matched):
            if number < self._recorded[topic]:
                stamp = min(stamp, self.component.outputs[topic][number].stamp)
        return stamp

    # --- inputs that did not come

    def _may_miss(self, before: Hypothesis, each: Input) -> bool:
        """Whether an input may not have come: it was not connected yet, or a queue was full."""
        if each.may_drop or each.stamp <= self.served_before:
            return True
        if each.earliest < self.served_before - CONNECTS:
            return True  # it is from before the recording, and so may the node have got it
        if self.component.is_bounded and before.free[0] >= each.stamp:
            return True
        is_new = each.lane == UNORDERED or each.lane not in before.connected
        return is_new and each.stamp <= self._timing.first + self._timing.slack

    # --- bodies

    def _ran(self, before: Hypothesis, candidate: Candidate, run: BodyRun) -> list[Hypothesis]:
        if run.failure is not None:
            self.failures[run.failure] = None
            return []
        ways = self.published(before, candidate, run.published)
        return [self._after(before, candidate, run, *way) for way in ways]

    def published(
        self, before: Hypothesis, candidate: Candidate, sent: tuple[SentMessage, ...]
    ) -> list[Fit]:
        """When a body may have run by what it publishes, and the outputs that fit then."""
        ways = [(candidate.low, candidate.high, before.matched)]
        for each in sent:
            topic = self.component.by_server.get(each.server)
            if topic is not None:
                ways = [after for way in ways for after in self._fitting(way, topic, each)]
        return ways

    def _fitting(self, way: Fit, topic: int, sent: SentMessage) -> list[Fit]:
        found: list[Fit] = []
        low, high, matched = way
        number, timing = matched[topic], self._timing
        elapsed = sent.after * timing.unit
        if number < self._recorded[topic]:
            output = self.component.outputs[topic][number]
            stamp = output.stamp - elapsed
            if self.is_output(output, sent):
                old = 0.0 if number else self.component.kept[topic]
                first, last = max(low, stamp - timing.slack - old), min(high, stamp)
                if first <= last:
                    now = (*matched[:topic], number + 1, *matched[topic + 1 :])
                    found.append((first, last, now))
            high = min(high, stamp)
        if number or low + elapsed > timing.first + CONNECTS:
            low = max(low, timing.end - timing.slack - elapsed)
        if low <= high:
            found.append((low, high, matched))
        return found

    def is_output(self, output: Output, sent: SentMessage) -> bool:
        """Whether a recorded message has the values that a body publishes."""
        return is_same(self.component.program, sent.server, output.cells, sent.cells)

    def _after(
        self,
        before: Hypothesis,
        candidate: Candidate,
        run: BodyRun,
        low: float,
        high: float,
        matched: tuple[int, ...],
    ) -> Hypothesis:
        unit = self._timing.unit
        self.raced |= self._races(before, candidate, low)
        _, _, free, _, pending, base, taken, _, connected, _ = before
        server, _, _, _, posted, number, received = candidate
        if posted is not None or run.posted:
            still = list(pending)
            if posted is not None:
                still.remove(posted)
            for after in run.posted:
                due = after.after * unit
                still.append(Posted(after.server, after.cells, low + due, high + due))
            pending = tuple(sorted(still))
        if received is not None:
            base, taken = advanced(before, number)
            if received.lane not in connected:
                connected |= {received.lane}
        if run.busy:
            free = low + run.busy * unit, high + run.busy * unit
        return Hypothesis(
            low, high, free, run.variables, pending, base, taken, matched, connected, server
        )

    def _races(self, before: Hypothesis, candidate: Candidate, low: float) -> bool:
        """Whether a body may have run beside the one before it, in another thread."""
        component = self.component
        if not component.in_threads or before.last in (-1, candidate.server):
            return False
        if low - self._timing.slack <= before.free[1]:
            return True
        pair = before.last, candidate.server
        return pair in component.conflicts and low - self._timing.slack <= before.high


def _until(outputs: Sequence[Output], time: float) -> int:
    """The number of messages up to a time, which are all but the last ones."""
    number = len(outputs)
    while number and outputs[number - 1].stamp > time:
        number -= 1
    return number
