"""State spaces in which what rebecs do and hold has the same names in two models."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field
from typing import TypeAlias

from rebsync.checker.endless import EndlessBody, endless_reason
from rebsync.checker.lowering import lower
from rebsync.checker.machine import Sent
from rebsync.checker.outcomes import Outcome
from rebsync.checker.program import Cell, Program
from rebsync.checker.state import Local, Message, State
from rebsync.checker.steps import TIME, Action, Failure, Step
from rebsync.checker.telling import Teller
from rebsync.checker.views import view_of
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Place
from rebsync.roundtrip.diff.matching import Matching
from rebsync.roundtrip.diff.operands import Operand
from rebsync.source import NOWHERE, Span

FAILED = -1  # where a failing step leads to
ROOT = 0  # the state before the constructors

Observed: TypeAlias = tuple[tuple[str, str, str], ...]
"""Rebec, variable and value."""

Known: TypeAlias = dict[Observed, int]
"""Numbers for what rebecs hold: the same for both sides."""

Delivery: TypeAlias = tuple[str, str, tuple[str, ...], int, int | None]
"""Receiver, server, arguments, and from now the time of arrival and the deadline."""


@dataclass(frozen=True, slots=True)
class Event:
    """What can be seen of a step, and what each rebec holds after it, as numbers."""

    kind: str
    rebec: str
    server: str
    arguments: tuple[str, ...]
    time: int
    sent: tuple[Delivery, ...]
    failure: str
    after: tuple[int, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Vocabulary:
    """What one model's rebecs, variables and servers are called in both.

    Variables go by the class of a rebec and their name; what is not in there is not seen.
    """

    rebecs: Mapping[str, str]
    variables: Mapping[tuple[str, str], str]
    servers: Mapping[tuple[str, str], str]


def words_of(side: Operand, matching: Matching, is_left: bool) -> Vocabulary:
    """The words of a side: those of the left one for what both have."""
    called = {id(pair[0 if is_left else 1].node): pair[0].name for pair in matching.pairs}
    rebecs = {i.name: called.get(id(i.node), f"{i.name}'") for i in side.items if i.kind == "rebec"}
    variables, servers = {}, {}
    for info in side.analysis.classes.values():
        for symbol in info.state:
            if id(symbol.declaration) in called:
                variables[info.name, symbol.name] = called[id(symbol.declaration)]
        for server in info.servers:
            servers[info.name, server.name] = called.get(id(server.declaration), f"{server.name}'")
    if is_left:
        rebecs = {name: name for name in rebecs}
        servers = {key: key[1] for key in servers}
    return Vocabulary(rebecs, variables, servers)


@dataclass(slots=True, eq=False)
class Transitions:
    """The steps of one model, made when they are asked for. State 0 is before the constructors."""

    side: Operand
    words: Vocabulary
    known: Known
    numbers: dict[State, int] = field(default_factory=dict)
    states: list[State] = field(default_factory=lambda: [()])
    made: dict[int, tuple[tuple[Event, int, Step], ...]] = field(default_factory=dict)
    reason: str = ""
    program: Program = field(init=False)
    teller: Teller = field(init=False)
    order: list[int] = field(init=False)  # of the rebecs, by the names of both sides
    held: dict[tuple[int, tuple[Cell, ...]], int] = field(default_factory=dict)
    told: dict[tuple[Message, int], Delivery] = field(default_factory=dict)
    outcomes: dict[tuple[int, Local], tuple[Outcome, ...]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.program, _ = lower(self.side.analysis)
        self.teller = Teller(view_of(self.program, "tts"), self.side.given.source)
        names = [self._rebec(rebec.name) for rebec in self.program.rebecs]
        self.order = sorted(range(len(names)), key=lambda index: names[index])

    def steps(self, state: int) -> tuple[tuple[Event, int, Step], ...]:
        """The steps from a state: what is seen, the next state, and the step itself.

        None where a body does not end; `reason` then says so.
        """
        if state not in self.made:
            try:
                self.made[state] = tuple(self._steps(state))
            except EndlessBody as endless:
                self.reason = endless_reason(self.program, endless.cut)
                self.made[state] = ()
        return self.made[state]

    def explore(self, most: int) -> str:
        """Makes all steps; why that did not end, or an empty text."""
        at = 0
        while at < len(self.states):
            if len(self.states) > most:
                return f"the bound of {most:,} states was reached"
            self.steps(at)
            if self.reason:
                return self.reason
            at += 1
        return ""

    def is_made(self, state: int) -> bool:
        """Whether the steps of a state are known."""
        return state in self.made

    def _steps(self, number: int) -> Iterator[tuple[Event, int, Step]]:
        before = self.states[number]
        view = self.teller.view
        for step in view.steps(before) if number else view.initial_states():
            target = FAILED
            if not isinstance(step.result, Failure):
                target = self.numbers.setdefault(step.result, len(self.states))
                if target == len(self.states):
                    self.states.append(step.result)
            yield self._event(before, step), target, step

    # --- what is seen ---------------------------------------------------------------------------

    def _event(self, before: State, step: Step) -> Event:
        action, result = step.action, step.result
        acts = bool(before) and action.actor != TIME
        kind = "take" if action.slot >= 0 else "resume" if acts else "time" if before else "start"
        served = self._served(before, action) if acts else ("", "", ())
        if isinstance(result, Failure):
            return Event(kind, *served, step.time, (), result.kind, ())
        sent = self._sent(before, action) if acts else ()
        return Event(kind, *served, step.time, sent, "", self._after(result))

    def _served(self, before: State, action: Action) -> tuple[str, str, tuple[str, ...]]:
        """Who acts, and the message that it serves; a constructor has none."""
        local = before[action.actor]
        message = local.bag[action.slot] if action.slot >= 0 else None
        if message is None and local.point is not None:
            message = local.point.message
        if message is None or message.server < 0:
            return self._rebec(self.program.rebecs[action.actor].name), "", ()
        return self._delivery(message, action.actor)[:3]

    def _sent(self, before: State, action: Action) -> tuple[Delivery, ...]:
        """What a step sends; bags do not keep the order in which messages come into them."""
        key = action.actor, before[action.actor]
        if key not in self.outcomes:
            self.outcomes[key] = tuple(self.teller.view.actors[action.actor].outcomes(key[1]))
        sends: tuple[Sent, ...] = next(
            o.sends
            for o in self.outcomes[key]
            if o.slot == action.slot and o.choices[: len(action.choices)] == action.choices
        )
        found = (self._delivery(sent.message, sent.receiver) for sent in sends)
        return tuple(sorted(found, key=repr))

    def _delivery(self, message: Message, receiver: int) -> Delivery:
        if (message, receiver) not in self.told:
            shown = self.teller.message(message, receiver, 0)
            rebec = self.program.rebecs[receiver]
            server = self.words.servers.get((rebec.class_name, shown.server), shown.server)
            values = tuple(self._rebec(value) for _, value in shown.arguments)
            delivery = self._rebec(rebec.name), server, values, shown.arrival, shown.deadline
            self.told[message, receiver] = delivery
        return self.told[message, receiver]

    def _after(self, state: State) -> tuple[int, ...]:
        return tuple(self._held(index, state) for index in self.order)

    def _held(self, index: int, state: State) -> int:
        """The number of what a rebec holds."""
        key = index, state[index].variables
        if key not in self.held:
            rebec = self.program.rebecs[index]
            (shown,) = self.teller.state(state, 0)[index : index + 1]
            found = []
            for name, value in shown.variables:
                plain, bracket, place = name.partition("[")
                known = self.words.variables.get((rebec.class_name, plain))
                if known is not None:
                    variable = f"{known}{bracket}{place}"
                    found.append((self._rebec(rebec.name), variable, self._rebec(value)))
            self.held[key] = self.known.setdefault(tuple(sorted(found)), len(self.known))
        return self.held[key]

    def _rebec(self, name: str) -> str:
        """What a rebec is called; other values stay as they are."""
        return self.words.rebecs.get(name, name)

    # --- places ---------------------------------------------------------------------------------

    def place(self, number: int, step: Step) -> Place | None:
        """Where the body of a step begins or goes on."""
        before, action = self.states[number], step.action
        if not before or action.actor == TIME:
            return None
        local = before[action.actor]
        if action.slot < 0 and local.point is not None:
            return self.side.place(self.program.spans[local.point.frames[-1].pc - 1])
        server = self.program.servers[local.bag[action.slot].server]
        return self.side.place(server.span, self._declared(server.class_name, server.name))

    def _declared(self, class_name: str, server: str) -> Span:
        """A server as a whole: code read by itself may not tell where its name is."""
        found = (s for s in self.side.analysis.classes[class_name].servers if s.name == server)
        symbol = next(found, None)
        return symbol.declaration.span if symbol is not None else NOWHERE
