"""Which delays and sends a body ran, by what a recording shows of it.

A body sees nothing but the state of its own rebec, so the interpreter can run it again by itself:
from the state before, with the message that it served. Of all ways to choose those count that end
in the state and take the time that was recorded.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from rebsync.checker.course import Delayed
from rebsync.checker.endless import EndlessBody
from rebsync.checker.machine import Coverage
from rebsync.checker.outcomes import Actor, Outcome
from rebsync.checker.program import NO_DEADLINE, NULL, Cell, Kind, Program
from rebsync.checker.state import Local, Message
from rebsync.conform.observable import Observable, kinds
from rebsync.conform.recording import Served

_REMEMBERED = 50_000  # bodies


class DelayRun(NamedTuple):
    """A delay that ran: its instruction, and how long it is in the model."""

    pc: int
    time: int


class SendRun(NamedTuple):
    """A send that ran, `elapsed` units after its body began; `after` and `deadline` as evaluated.

    `message` is what its receiver shows of it: receiver, server, arguments.
    """

    pc: int
    elapsed: int
    after: int
    deadline: int | None
    message: tuple[int, str, str]


class BodyPath(NamedTuple):
    """What a body ran, in its order."""

    delays: tuple[DelayRun, ...]
    sends: tuple[SendRun, ...]


class BodyRuns:
    """The bodies of a program, run again one by one."""

    def __init__(self, program: Program, observable: Observable) -> None:
        self._program = program
        self._observable = observable
        self._has_sender = any(i.op == "SENDER" for i in program.code)
        self._actors = [
            Actor(program, index, "ftts", Coverage()) for index in range(len(program.rebecs))
        ]
        self._known: dict[tuple[object, ...], tuple[BodyPath, ...]] = {}

    def paths(self, served: Served, before: Sequence[Cell] | None) -> tuple[BodyPath, ...]:
        """The ways that a body can have gone; `before` is the state before, None of constructors.

        None of them: what was recorded is nothing that the model does.
        """
        clock = served.start if self._program.reads_clock else 0
        arrived = served.arrival - served.start
        taken = served.now - served.start
        shown = (served.rebec, served.server, served.arguments, served.cells)
        key = (*shown, before, clock, arrived, taken)
        found = self._known.get(key)
        if found is None:
            if len(self._known) >= _REMEMBERED:
                self._known.clear()
            try:
                outcomes = self._outcomes(served, before, clock, arrived)
                found = tuple(dict.fromkeys(self._fitting(served, outcomes, taken)))
            except (EndlessBody, ValueError):
                found = ()
            self._known[key] = found
        return found

    def _outcomes(
        self, served: Served, before: Sequence[Cell] | None, clock: int, arrived: int
    ) -> Iterator[Outcome]:
        actor = self._actors[served.rebec]
        if before is None:
            yield from actor.construct(())
            return
        for server in self._servers(served):
            arguments = self._arguments(server, served.arguments)
            for sender in range(len(self._program.rebecs)) if self._has_sender else (NULL,):
                message = Message(arrived, server, sender, NO_DEADLINE, arguments)
                yield from actor.outcomes(Local(tuple(before), (message,), clock=clock))

    def _servers(self, served: Served) -> list[int]:
        """The servers of a rebec by a name, which may be overloaded."""
        dispatch = self._program.rebecs[served.rebec].dispatch
        servers = [number for number in dict.fromkeys(dispatch) if number >= 0]
        return [n for n in servers if self._program.servers[n].name == served.server]

    def _arguments(self, server: int, text: str) -> tuple[Cell, ...]:
        """The cells of arguments that a node has written. ValueError: they are of other types."""
        words = [word.strip(" []") for word in text.split(",")] if text else []
        wanted = kinds(self._program, server)
        if len(words) != len(wanted):
            raise ValueError(text)
        return tuple(self._cell(w, kind) for w, kind in zip(words, wanted, strict=True))

    def _cell(self, word: str, kind: Kind) -> Cell:
        if kind == "boolean":
            return int(word == "true")
        return self._observable.reader(kind)(word)

    def _fitting(
        self, served: Served, outcomes: Iterator[Outcome], taken: int
    ) -> Iterator[BodyPath]:
        for outcome in outcomes:
            local = outcome.result
            if (
                isinstance(local, Local)
                and local.busy == taken
                and self._observable.is_same(served.rebec, served.cells, local.variables)
            ):
                yield self._path(outcome)

    def _path(self, outcome: Outcome) -> BodyPath:
        delays = [event for event in outcome.course if isinstance(event, Delayed)]
        sends = []
        for number, sent in enumerate(outcome.sends):
            elapsed = sum(delay.time for delay in delays if delay.sends <= number)
            message = sent.message
            due = None if message.deadline == NO_DEADLINE else message.deadline - elapsed
            server = self._program.servers[message.server].name
            arguments = self._observable.arguments(message.server, message.arguments)
            shown = (sent.receiver, server, arguments)
            sends.append(SendRun(sent.pc, elapsed, message.arrival - elapsed, due, shown))
        return BodyPath(tuple(DelayRun(d.pc, d.time) for d in delays), tuple(sends))
