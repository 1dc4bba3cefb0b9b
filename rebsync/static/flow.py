"""Warnings about the course of bodies: dead statements, missing returns, full queues."""

from __future__ import annotations

from dataclasses import field

from rebsync.model import Block, Call, Constructor, MessageServer, Method, ReactiveClass, Statement
from rebsync.records import dataclass
from rebsync.static.facts import Facts, Send
from rebsync.static.paths import Exit, Outcome, Paths
from rebsync.static.symbols import ClassInfo, MethodSymbol, ServerSymbol

Declared = Constructor | MessageServer | Method


@dataclass(slots=True)
class _Flow:
    """The ways out of each body, weighed by its sends to self; None while one is computed."""

    facts: Facts
    to_self: set[int]
    outcomes: dict[int, Outcome | None] = field(default_factory=dict)

    def outcome(self, declaration: Declared) -> Outcome:
        key = id(declaration)
        if key not in self.outcomes:
            self.outcomes[key] = None
            paths = Paths(self._weigh, self._dead)
            body = declaration.body
            self.outcomes[key] = paths.sequence(body.statements) if body else {Exit.END: 0}
        return self.outcomes[key] or {}

    def least(self, declaration: Declared) -> int:
        """The number of sends to self on the path that has the fewest."""
        ends = self.outcome(declaration)
        return min((ends[e] for e in (Exit.END, Exit.RETURN) if e in ends), default=0)

    def _weigh(self, call: Call) -> int:
        symbol = self.facts.symbols.get(id(call))
        if isinstance(symbol, ServerSymbol):
            return int(id(call) in self.to_self)
        return self.least(symbol.declaration) if isinstance(symbol, MethodSymbol) else 0

    def _dead(self, statement: Statement) -> None:
        if not isinstance(statement, Block) or statement.statements:
            self.facts.warn("RS507", statement.span, "this statement is never reached")


def check_flow(facts: Facts) -> None:
    """Goes through every body once; sends to self count towards the queue."""
    flow = _Flow(facts, _sends_to_self(facts))
    for body in facts.bodies:
        ends = flow.outcome(body.declaration)
        if isinstance(body.declaration, Method) and Exit.END in ends:
            _check_returns(facts, body.declaration)
    for info in facts.infos:
        if not info.is_abstract:
            _check_queue(facts, info, flow)


def _check_returns(facts: Facts, method: Method) -> None:
    if method.type.name != "void" and method.body is not None:
        message = f'the method "{method.name}" can end without returning a value'
        facts.warn("RS520", method.name_span, message, "return a value on every path")


def _sends_to_self(facts: Facts) -> set[int]:
    return {
        id(event.call)
        for body in facts.bodies
        for event in body.events
        if isinstance(event, Send) and event.to_self
    }


def _check_queue(facts: Facts, info: ClassInfo, flow: _Flow) -> None:
    if not isinstance(info.declaration, ReactiveClass):
        return
    length = info.declaration.queue_length
    for constructor in info.constructors:
        sent = flow.least(constructor.declaration)
        if sent > length >= 1:
            message = f"the constructor sends itself {sent} messages, the queue holds {length}"
            _overflow(facts, info, constructor.declaration, message, sent)
    for server in info.servers:
        sent = flow.least(server.declaration)
        if sent + 1 > length >= 1 and sent:
            held = f"with the one it serves they exceed the queue of {length}"
            count = "a message" if sent == 1 else f"{sent} messages"
            message = f'"{server.name}" always sends itself {count}: {held}'
            _overflow(facts, info, server.declaration, message, sent + 1)


def _overflow(
    facts: Facts, info: ClassInfo, at: Constructor | MessageServer, message: str, needed: int
) -> None:
    own = any(member is at for member in getattr(info.declaration, "members", ()))
    span = at.name_span if own else info.declaration.name_span
    facts.warn("RS508", span, message, f"write reactiveclass {info.name}({needed}) or more")
