"""Units of hand-written code as reactive classes."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import TypeVar

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_timers import stale_messages, without_stale
from rebsync.reverse.bodies.cpp_unknowns import choice
from rebsync.reverse.bodies.effects.cpp_effects import touching
from rebsync.reverse.bodies.types.cpp_conversions import converted_to
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import TimerFact
from rebsync.reverse.models.building import declarations, mentioned
from rebsync.reverse.models.rewriting import STATEMENTS, rewritten
from rebsync.reverse.nodes.node_bodies import Bodies, repeated, takes_time
from rebsync.reverse.nodes.node_functions import Functions
from rebsync.reverse.nodes.node_lifecycle import is_transition
from rebsync.reverse.nodes.node_reach import unreached
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_setup import send
from rebsync.reverse.nodes.node_starts import started_late
from rebsync.reverse.nodes.node_tidying import tidy
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.nodes.node_unset import read_unset
from rebsync.reverse.nodes.node_unset_locals import with_set_locals
from rebsync.reverse.nodes.node_wide import Overflowing, overflowing
from rebsync.source import Span
from rebsync.statements import UNREADABLE
from rebsync.static.types import BOOLEAN

_Member = TypeVar("_Member", m.MessageServer, m.Method)
_BEAT = (
    "a timer that goes off while the node is busy keeps its beat;"
    " the model's goes on from when it is served"
)
_PACE = "a rate makes up for the time that its loop takes; the model's loop waits the whole period"


@dataclass(slots=True)
class NodeClass:
    """Puts one reactive class together; `known` are names and classes of its known rebecs.

    `overflowing` is what reading it has shown of the variables that hold more than an `int`.
    """

    name: str
    bodies: Bodies
    known: Sequence[tuple[str, str]]
    overflowing: Overflowing = Overflowing(frozenset(), frozenset())

    def read(self) -> m.ReactiveClass:
        """The class. What it has no place for is listed."""
        bodies, setup = self.bodies, self.bodies.setup
        functions = Functions(bodies)
        functions.choose()
        body = bodies.constructor()
        methods = functions.read()
        served = [self._with_set_locals(s, methods) for s in self._servers(methods)]
        body = with_set_locals(body, methods, bodies.findings, setup.within)
        methods = [self._with_set_locals(method, methods) for method in methods]
        self.overflowing = overflowing(bodies, body, served, methods)
        body = self._begun(body, served, methods)
        arguments = tuple(m.Parameter(p.type, p.name) for p in setup.parameters)
        own = bodies.state.variables
        constructor, late, variables = started_late(tidy(body, own), arguments, setup.names)
        variables = {**own, **variables}
        servers = [_tidied(s, variables) for s in [*late, *served]]
        servers, constructor = _without_idle(servers, constructor, {n for _, n in setup.loops})
        methods = [_tidied(method, variables) for method in methods]
        arguments = self._needed(arguments, constructor)
        self._note_unreached()
        methods = _reached([*servers, *methods], constructor, methods)
        state = mentioned(variables, [*servers, *methods, constructor])
        members: list[m.ClassMember] = []
        if self.known:
            members.append(m.KnownRebecs(declarations((n, m.Type(t)) for n, t in self.known)))
        if state:
            members.append(m.StateVars(declarations(state.items())))
        members.append(m.Constructor(self.name, arguments, constructor))
        members += [*servers, *methods]
        stale = stale_messages(setup.switches, [*servers, *methods])
        return m.ReactiveClass(
            self.name,
            bodies.unit.queue(len(setup.loops)) + stale,
            tuple(members),
            span=self._span(),
        )

    def _with_set_locals(self, member: _Member, methods: Sequence[m.Method]) -> _Member:
        if member.body is None:
            return member
        within = f"{self.bodies.unit.name}.{member.name}"
        body = with_set_locals(member.body, methods, self.bodies.findings, within)
        return replace(member, body=body)

    def _servers(self, methods: Sequence[m.Method]) -> list[m.MessageServer]:
        """The servers of callbacks, timers and loops; those of timers send to themselves again."""
        setup = self.bodies.setup
        found = [self.bodies.server(s) for s in self.bodies.servers]
        found += [s for loop, name in setup.loops for s in self.bodies.loop(loop, name)]
        delays = any(map(takes_time, found)) or any(map(takes_time, methods))
        if delays:
            self._note_beats()
        return [self._repeated(s, delays) for s in found]

    def _repeated(self, server: m.MessageServer, delays: bool) -> m.MessageServer:
        """The server of a timer with what makes it go on."""
        setup, body = self.bodies.setup, server.body
        if body is None:
            return server
        if server.name in setup.periodic:
            body = repeated(body, send(server.name, setup.periodic[server.name]), delays)
        if server.name in setup.switches:
            body = without_stale(body, setup.switches[server.name])
        return replace(server, body=body)

    def _begun(
        self, body: m.Block, servers: Sequence[m.MessageServer], methods: Sequence[m.Method]
    ) -> m.Block:
        """The constructor with choices for what C++ leaves open; lists where that is too much."""
        bodies = self.bodies
        unset = bodies.state.unset
        variables = {n: t for n, t in bodies.state.variables.items() if n in unset}
        chosen: list[m.Statement] = []
        for name in read_unset(variables, body, servers, methods):
            left = unset[name]
            span, within = left.cpp.span(left.node), bodies.setup.within
            why = f'"{left.name}" has no value that is known when it is first read'
            values = left.variable.domain
            if not values and variables[name] == BOOLEAN:
                values = m.BoolLiteral(True), m.BoolLiteral(False)
            if not values or variables[name].dimensions:
                unread = Unread(span, why, "give it an initial value")
                bodies.findings.unreadable(left.cpp.source, unread, within)
                continue
            scope = bodies.scope(left.cpp, None)
            options = tuple(converted_to(scope, v, left.variable) for v in values)
            bodies.findings.approximated(left.cpp.source, span, why, within=within)
            chosen.append(
                m.ExpressionStatement(m.Assign("=", m.Name(name), choice(options)), (), span)
            )
        return replace(body, statements=(*chosen, *body.statements))

    def _note_beats(self) -> None:
        """Lists the timers of a node that is busy at times."""
        for fact in self.bodies.unit.facts:
            if isinstance(fact, TimerFact) and fact.one_shot is not True:
                place, within = fact.site.place, self.bodies.setup.within
                self.bodies.findings.assumed(place.source, place.span, _BEAT, within=within)
        for loop, _ in self.bodies.setup.loops:
            if loop.rate is not None:
                place, within = loop.rate.site.place, self.bodies.setup.within
                self.bodies.findings.assumed(place.source, place.span, _PACE, within=within)

    def _note_unreached(self) -> None:
        """Lists functions that act on what the model has, and that something not read calls."""
        bodies = self.bodies
        for function in unreached(bodies.code, bodies.unit, bodies.setup.first, bodies.servers):
            assert function.body is not None
            if any(h.function == function.name for h in bodies.held()):
                continue
            if is_transition(bodies.unit, function):
                continue
            scope = bodies.scope(function.cpp, function)
            if touching(function.cpp, scope, function.body) is not None:
                why = "something calls this that is not read: what it does is not in the model"
                name = function.node.child_by_field_name("declarator")
                span = function.cpp.span(name if name is not None else function.node)
                within = bodies.within(function.name)
                bodies.findings.unreadable(function.cpp.source, Unread(span, why), within)

    def _needed(self, arguments: tuple[m.Parameter, ...], body: m.Block) -> tuple[m.Parameter, ...]:
        """The parameters that the constructor uses: others only say when a timer goes off."""
        if not arguments:
            return ()
        used = {n.name for n in m.walk(body) if isinstance(n, m.Name)}
        setup = self.bodies.setup
        setup.parameters = [p for p in setup.parameters if p.name in used]
        return tuple(a for a in arguments if a.name in used)

    def _span(self) -> Span:
        unit = self.bodies.unit
        if unit.owner is not None:
            return unit.owner.cpp.span(unit.owner.node)
        assert unit.program is not None
        return unit.program.main.cpp.span(unit.program.main.node)


def too_deep(
    name: str,
    unit: Unit,
    served: Sequence[Server],
    known: Sequence[tuple[str, str]],
    findings: Findings,
) -> m.ReactiveClass:
    """A class whose bodies are all listed: they lead deeper than they can be read."""
    lacking = m.Block((m.Empty((m.Annotation(UNREADABLE),)),))
    members: list[m.ClassMember] = []
    if known:
        members.append(m.KnownRebecs(declarations((n, m.Type(t)) for n, t in known)))
    members.append(m.Constructor(name, (), lacking))
    for server in served:
        taken = tuple(m.Parameter(p.type, p.name) for p in server.parameters)
        members.append(m.MessageServer(server.name, taken, lacking))
    for function in unit.functions:
        span = function.cpp.span(function.node)
        unread = Unread(span, "this, or what it calls, leads deeper than it can be read")
        findings.unreadable(function.cpp.source, unread, f"{unit.name}.{function.name}")
    return m.ReactiveClass(name, 10, tuple(members))


def _tidied(member: _Member, variables: Collection[str]) -> _Member:
    return replace(member, body=tidy(member.body, variables)) if member.body is not None else member


def _without_idle(
    servers: list[m.MessageServer], constructor: m.Block, loops: set[str]
) -> tuple[list[m.MessageServer], m.Block]:
    """Without the loops that only wait, and what starts them."""
    idle = {s.name for s in servers if s.name in loops and s.body and _sends_only(s.body, s.name)}

    def change(node: object) -> object:
        if not isinstance(node, m.Block):
            return node
        kept = tuple(s for s in node.statements if not any(_sends(s, name) for name in idle))
        return replace(node, statements=kept)

    if not idle:
        return servers, constructor
    others = [rewritten(s, change, STATEMENTS) for s in servers if s.name not in idle]
    return others, rewritten(constructor, change, STATEMENTS)


def _sends_only(body: m.Block, server: str) -> bool:
    return all(_sends(s, server) for s in body.statements)


def _sends(statement: m.Statement, server: str) -> bool:
    match statement:
        case m.ExpressionStatement(m.Call(m.Self(), name)):
            return name == server
        case _:
            return False


def _reached(
    members: Sequence[m.MessageServer | m.Method], constructor: m.Block, methods: list[m.Method]
) -> list[m.Method]:
    """The methods that servers, the constructor, or such methods call."""
    if not methods:
        return []
    bodies: list[m.Node] = [constructor, *(s for s in members if isinstance(s, m.MessageServer))]
    found: dict[str, m.Method] = {}
    while bodies:
        for node in m.walk(bodies.pop()):
            if isinstance(node, m.Call) and isinstance(node.target, m.Self | None):
                for method in methods:
                    if method.name == node.name and method.name not in found:
                        found[method.name] = method
                        bodies.append(method)
    return [method for method in methods if method.name in found]
