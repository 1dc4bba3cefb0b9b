"""Measures what the bodies of a recording took.

A node shows a body when it has ended. When it began is computed: not before its model time, not
before the body before it had ended, and not before its message was sent. So a body that is late
because others are is not slow; what middleware and scheduling take counts as its own time.
"""

from __future__ import annotations

from array import array
from collections import defaultdict, deque
from typing import NamedTuple

from rebsync.calibration.bodies import BodyPath, BodyRuns, SendRun
from rebsync.calibration.times import Sample
from rebsync.conform.matching import Subject
from rebsync.conform.recording import Served

_SOON = 0.1  # of the slack: a body that begins so late waits for as long as it should, about
CONSTRUCTOR = "constructor"

Key = tuple[int, str, str, int]
"""A message as its receiver shows it: receiver, server, arguments, arrival."""


class _Sending(NamedTuple):
    """A send with when it happened, in units since time 0, and the body that it is in."""

    send: SendRun
    at: float
    by: Served
    ended: float


class _Ran(NamedTuple):
    """A body, when it ended, when the one before it did, and what it ran (None: not certain)."""

    served: Served
    ended: float
    free: float
    path: BodyPath | None


class Series:
    """Samples, as three numbers each."""

    __slots__ = ("_numbers",)

    def __init__(self) -> None:
        self._numbers = array("d")

    def add(self, model: int, measured: float, late: float) -> None:
        """One more."""
        self._numbers.extend((model, max(measured, 0.0), late))

    def samples(self) -> tuple[Sample, ...]:
        """All of them."""
        n = self._numbers
        return tuple(Sample(int(n[i]), n[i + 1], n[i + 2]) for i in range(0, len(n), 3))


class Measuring:
    """Takes the bodies of a recording in its order; `zero` is time 0 on the recording's clock."""

    def __init__(self, subject: Subject, zero: float) -> None:
        self._unit = subject.time_unit
        self._soon = _SOON * subject.slack / subject.time_unit
        self._zero = zero
        self._bodies = BodyRuns(subject.program, subject.observable)
        self._last: dict[int, tuple[Served, float]] = {}
        self._sent: dict[Key, deque[_Sending]] = defaultdict(deque)
        self._unmatched: dict[Key, deque[_Ran]] = defaultdict(deque)
        self._count = 0
        self.unknown = 0
        self.delays: dict[int, Series] = defaultdict(Series)
        self.together: dict[int, set[int]] = defaultdict(set)
        self.shortened: dict[int, int] = defaultdict(int)
        self.afters: dict[int, Series] = defaultdict(Series)
        self.deadlines: dict[int, Series] = defaultdict(Series)
        self.periods: dict[int, Series] = defaultdict(Series)
        self.instant: dict[tuple[int, str], Series] = defaultdict(Series)

    def see(self, served: Served) -> None:
        """A body that has ended."""
        self._count += 1
        ended = (served.stamp - self._zero) / self._unit
        if served.server == CONSTRUCTOR:
            ended = float(served.now)  # they run before time 0, and tell it when somebody listens
        before, free = self._last.get(served.rebec, (None, 0.0))
        self._last[served.rebec] = (served, ended)
        path = self._path(served, before)
        ran = _Ran(served, ended, free, path)
        if served.server == CONSTRUCTOR:
            self._finish(ran, None)
        else:
            key = (served.rebec, served.server, served.arguments, served.arrival)
            waiting = self._sent.get(key)
            if waiting:
                self._finish(ran, waiting.popleft())
            else:
                self._unmatched[key].append(ran)
        if path is not None:
            self._send(ran, path)

    def end(self) -> None:
        """What nobody was seen to send is measured without that."""
        for waiting in self._unmatched.values():
            for ran in waiting:
                self._finish(ran, None)
        self._unmatched.clear()

    @property
    def count(self) -> int:
        """How many bodies were seen."""
        return self._count

    def _path(self, served: Served, before: Served | None) -> BodyPath | None:
        """What a body ran, if that is certain; of the first body of a rebec nobody knows it."""
        if before is None and served.server != CONSTRUCTOR:
            self.unknown += 1
            return None
        cells = before.cells if before is not None else None
        paths = self._bodies.paths(served, None if served.server == CONSTRUCTOR else cells)
        if len(paths) != 1:
            self.unknown += 1
            return None
        return paths[0]

    def _send(self, ran: _Ran, path: BodyPath) -> None:
        served = ran.served
        total = served.now - served.start
        for send in path.sends:
            at = ran.ended
            if send.elapsed < total:
                at = min(max(float(served.start + send.elapsed), ran.free), ran.ended)
            key = (*send.message, served.start + send.elapsed + send.after)
            sending = _Sending(send, at, served, ran.ended)
            waiting = self._unmatched.get(key)
            if waiting:
                self._finish(waiting.popleft(), sending)
            else:
                self._sent[key].append(sending)

    def _finish(self, ran: _Ran, sending: _Sending | None) -> None:
        """Measures a body whose message is known, or is never seen to be sent."""
        served, path = ran.served, ran.path
        sent = sending.at if sending is not None else 0.0
        began = max(float(served.start), ran.free, sent)
        took = ran.ended - began
        late = ran.ended - served.now
        if path is not None and served.server != CONSTRUCTOR:
            self._body(served, path, took, late, began)
        if sending is not None:
            self._message(ran, sending, began, late)

    def _body(self, served: Served, path: BodyPath, took: float, late: float, began: float) -> None:
        total = served.now - served.start
        delays = [delay for delay in path.delays if delay.time > 0]
        if not delays:
            self.instant[served.rebec, served.server].add(0, took, late)
            return
        shortened = began - served.start > self._soon and took < total
        for delay in delays:
            self.together[delay.pc].update(other.pc for other in delays)
            if shortened:
                self.shortened[delay.pc] += 1
            else:
                self.delays[delay.pc].add(delay.time, delay.time + took - total, late)

    def _message(self, ran: _Ran, sending: _Sending, began: float, late: float) -> None:
        """From when a message was sent until it was served; a body without delay ends at once."""
        send, served = sending.send, ran.served
        is_instant = served.now == served.start
        taken = ran.ended if is_instant else began
        if send.deadline is not None:
            self.deadlines[send.pc].add(send.deadline, taken - sending.at, late)
        if send.after <= 0:
            return
        waits = ran.free > max(float(served.arrival), sending.at)
        if is_instant and not waits and served.start == served.arrival:
            self.afters[send.pc].add(send.after, taken - sending.at, late)
        if sending.by.rebec == served.rebec and sending.by.server == served.server:
            period = served.now - sending.by.now
            self.periods[send.pc].add(period, ran.ended - sending.ended, late)
