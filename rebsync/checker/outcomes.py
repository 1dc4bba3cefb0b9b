"""What one rebec can do by itself: a body sees nothing but the state of its own rebec.

So a step of the whole system is an outcome of one rebec, and the delivery of what it sent.
"""

from __future__ import annotations

from bisect import bisect
from collections.abc import Iterator

from rebsync.checker.course import Course
from rebsync.checker.endless import BUDGET, WAYS, Cut, EndlessBody
from rebsync.checker.look import Look, unwatched
from rebsync.checker.machine import Coverage, Failed, Machine, Sent
from rebsync.checker.program import NO_DEADLINE, NULL, UNRANKED, Program
from rebsync.checker.state import Local, Message
from rebsync.checker.steps import Failure, Semantics
from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Outcome:
    """A way to act: the new local state, or the failure after `sends` went out.

    `sends` has those to the rebec itself too, which are in the new state already. `picked` are
    the instructions that evaluated the choices, `course` the delays (and moves) on the way.
    """

    slot: int
    choices: tuple[int, ...]
    result: Local | Failure
    sends: tuple[Sent, ...] = ()
    picked: tuple[int, ...] = ()
    course: tuple[Course, ...] = ()


class Actor:
    """One rebec of a program. It remembers its outcomes, and the largest bag that it had.

    What it calls between two of them, `look`, may raise what ends the work. A body is given up
    after `budget` instructions.
    """

    def __init__(
        self, program: Program, index: int, semantics: Semantics, coverage: Coverage
    ) -> None:
        self.program = program
        self.index = index
        self.rebec = program.rebecs[index]
        self.semantics = semantics
        self.coverage = coverage
        self.largest = 0
        self.look: Look = unwatched
        self.budget = BUDGET
        self._known: dict[Local, tuple[Outcome, ...]] = {}

    # --- who may act

    def candidates(self, local: Local) -> list[int]:
        """The slots of the messages that may be taken now.

        Of those that have arrived the earliest, of these the ones that @priority ranks first; of
        a FIFO queue the first.
        """
        if not local.bag or local.busy or local.point:
            return []
        if self.semantics == "core":
            return [0]
        first = local.bag[0].arrival
        if first > 0:
            return []
        tied = [slot for slot, message in enumerate(local.bag) if message.arrival == first]
        rank = min(self._rank(local.bag[slot]) for slot in tied)
        return [slot for slot in tied if self._rank(local.bag[slot]) == rank]

    def rank(self, local: Local) -> int | None:
        """The priority with which the rebec can act now; None when it cannot."""
        if local.point:
            message = local.point.message
            if local.busy:
                return None
        else:
            slots = self.candidates(local)
            if not slots:
                return None
            message = local.bag[slots[0]]
        if self.semantics == "core":
            return 0
        return self._rank(message) if self.program.global_ranks else self.rebec.priority

    def _rank(self, message: Message) -> int:
        return self.program.servers[message.server].priority if message.server >= 0 else UNRANKED

    # --- what it does

    def outcomes(self, local: Local) -> tuple[Outcome, ...]:
        """All that the rebec can do now: slots in the order of the bag, then choices."""
        found = self._known.get(local)
        if found is None:
            found = self._known[local] = tuple(self._act(local))
        return found

    def _act(self, local: Local) -> Iterator[Outcome]:
        if local.point:
            yield from self._run(local, -1)
            return
        for slot in self.candidates(local):
            message = local.bag[slot]
            if message.deadline < 0:
                body = self.program.servers[message.server].body
                entry = self.program.bodies[body].entry
                yield Outcome(slot, (), Failure("deadline", entry, self.index))
            else:
                yield from self._run(local, slot)

    def act_again(self, local: Local, slot: int, choices: tuple[int, ...]) -> None:
        """Runs the body again that was run with some choices, for what it covers."""
        self._once(local, slot, list(choices))

    def construct(self, bag: tuple[Message, ...]) -> Iterator[Outcome]:
        """What the constructor can do; `bag` has what earlier constructors have sent."""
        variables = [
            NULL if s.kind == "rebec" else 0 for s in self.rebec.state for _ in range(s.size)
        ]
        blank = Local(tuple(variables), bag)
        if self.rebec.constructor < 0:
            yield Outcome(-1, (), blank)
        else:
            yield from self._run(blank, -1)

    def _run(self, local: Local, slot: int) -> Iterator[Outcome]:
        """Runs a body once for each way to choose, the last choice changing first."""
        choices: list[int] = []
        for _ in range(WAYS):
            machine, outcome = self._once(local, slot, choices)
            yield outcome
            self.look()
            choices = machine.choices[: len(machine.options)]
            while choices and choices[-1] == machine.options[len(choices) - 1] - 1:
                choices.pop()
            if not choices:
                return
            choices[-1] += 1
        entry = self._entry(local, slot)
        raise EndlessBody(Cut("ways", entry, entry, WAYS))

    def _entry(self, local: Local, slot: int) -> int:
        """The instruction at which a run of a body begins, in its outermost frame."""
        if local.point:
            return local.point.frames[0].pc - 1
        body = self.rebec.constructor
        if slot >= 0:
            body = self.program.servers[local.bag[slot].server].body
        return self.program.bodies[body].entry

    def _once(self, local: Local, slot: int, choices: list[int]) -> tuple[Machine, Outcome]:
        message, bag = self._taken(local, slot)
        served = message.server >= 0
        room = self.rebec.capacity - len(bag) - served
        machine = Machine(
            self.program,
            self.rebec,
            self.index,
            list(local.variables),
            message,
            local.clock,
            choices,
            self.semantics == "tts",
            room,
            self.coverage,
            look=self.look,
            budget=self.budget,
        )
        failure = None
        try:
            self._start(machine, local, message)
        except Failed as failed:
            failure = failed.failure
        own = [s.message for s in machine.sends if s.receiver == self.index]
        self.largest = max(self.largest, len(bag) + served + len(own))
        result = failure or self._after(machine, local, bag, own)
        outcome = Outcome(
            slot,
            tuple(machine.choices),
            result,
            tuple(machine.sends),
            tuple(machine.picked),
            tuple(machine.course),
        )
        return machine, outcome

    def _taken(self, local: Local, slot: int) -> tuple[Message, tuple[Message, ...]]:
        """The message to serve, and the bag without it."""
        if local.point:
            return local.point.message, local.bag
        if slot < 0:
            return Message(0, -1, self.index, NO_DEADLINE, ()), local.bag
        return local.bag[slot], (*local.bag[:slot], *local.bag[slot + 1 :])

    def _start(self, machine: Machine, local: Local, message: Message) -> None:
        if local.point:
            machine.resume(local.point)
        elif message.server < 0:
            machine.start(self.rebec.constructor, self.rebec.arguments)
        else:
            server = self.program.servers[message.server]
            self.coverage.servers.add(message.server)
            machine.start(server.body, message.arguments)

    def _after(
        self, machine: Machine, local: Local, bag: tuple[Message, ...], own: list[Message]
    ) -> Local:
        point, busy = None, machine.elapsed
        if machine.delayed is not None:
            point, busy = machine.suspended(), machine.delayed
        for message in own:
            bag = self.added(bag, message)
        return Local(tuple(machine.variables), bag, busy, point, local.clock)

    # --- what comes to it

    def added(self, bag: tuple[Message, ...], message: Message) -> tuple[Message, ...]:
        """The bag with one more message: a sorted multiset, or a queue."""
        if self.semantics == "core":
            return (*bag, message)
        place = bisect(bag, message)
        return (*bag[:place], message, *bag[place:])

    def receive(self, local: Local, message: Message) -> Local | None:
        """The local state with one more message; None when there is no place for it."""
        local = self._displaced(local, message.server)
        if local.places == self.rebec.capacity:
            return None
        self.largest = max(self.largest, local.places + 1)
        return local._replace(bag=self.added(local.bag, message))

    def _displaced(self, local: Local, server: int) -> Local:
        """The local state without the message that is lost when another comes for a server."""
        depth = self.program.servers[server].depth if server >= 0 else 0
        waiting = [n for n, each in enumerate(local.bag) if each.server == server] if depth else []
        if not depth or len(waiting) < depth:
            return local
        return local._replace(bag=(*local.bag[: waiting[0]], *local.bag[waiting[0] + 1 :]))
