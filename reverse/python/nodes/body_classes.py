"""One unit of Python as a reactive class: its constructor, servers, and state variables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field as with_default
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.intervals import Interval
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.invariants import Body, BodyStart, Unbounded, unbounded
from rebsync.reverse.bodies.cpp_timers import stale_messages, without_stale
from rebsync.reverse.bodies.made_locals import tidied
from rebsync.reverse.findings import Unread
from rebsync.reverse.graph import TimerFact
from rebsync.reverse.models.building import declarations, mentioned
from rebsync.reverse.models.rewriting import rewritten
from rebsync.reverse.nodes.node_bodies import repeated, takes_time, without_end
from rebsync.reverse.nodes.node_loops import left
from rebsync.reverse.nodes.node_names import Names
from rebsync.reverse.nodes.node_servers import ParameterField, Server
from rebsync.reverse.nodes.node_setup import send
from rebsync.reverse.nodes.node_starts import started_late
from rebsync.reverse.nodes.node_tidying import tidy
from rebsync.reverse.python.bodies.body_messages import PROBE
from rebsync.reverse.python.bodies.body_node_loops import EndlessLoop
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Frame, Message, Nobody, bounds, field_kind
from rebsync.reverse.python.bodies.body_statements import PyStatements
from rebsync.reverse.python.bodies.body_timers import switch_of
from rebsync.reverse.python.bodies.body_units import runs_in_threads
from rebsync.reverse.python.expressions.values import TYPES, WHOLE
from rebsync.reverse.python.nodes.body_starts import constructor, declared
from rebsync.reverse.python.nodes.object_model import decorated_callback
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.py_index import LAMBDA, Scope
from rebsync.reverse.syntax.py_tree import field, named

_ASLEEP = "other callbacks may run while this one sleeps: the model runs none"
_BEAT = (
    "a timer that goes off while the node is busy keeps its beat;"
    " the model's goes on from when it is served"
)


@dataclass(slots=True)
class ReadServer:
    """A message server that was read: `ranges` are what its parameters can be."""

    name: str
    statements: tuple[m.Statement, ...]
    parameters: tuple[ParameterField, ...] = ()
    ranges: Mapping[str, Interval] = with_default(default_factory=dict)
    node: Node | None = None


@dataclass(eq=False, slots=True)
class PyClass:
    """Reads all bodies of a unit once."""

    reading: Reading
    constructor: tuple[m.Statement, ...] = ()
    served: list[ReadServer] = with_default(default_factory=list)
    loops: list[EndlessLoop] = with_default(default_factory=list)
    types: dict[str, m.Type] = with_default(default_factory=dict)
    _proof: Unbounded | None = None

    def read(self) -> None:
        """All bodies."""
        reading = self.reading
        self.constructor = constructor(reading, self.loops)
        done: set[str] = set()
        for number, server in reading.servers.items():
            if server.name not in done:
                done.add(server.name)
                self.served.append(self._server(server, number))
        for loop in self.loops:
            self.served.append(self._loop(loop))
        self.constructor = (*declared(reading), *self.constructor)
        self.types = self._types()

    @property
    def proof(self) -> Unbounded:
        """What following all bodies shows, once they are read."""
        if self._proof is None:
            servers = [self._followed(s.statements, s.ranges) for s in self.served]
            start = self._followed(self.constructor, {})
            self._proof = unbounded(start, servers, self.reading.state, self.reading.wide)
        return self._proof

    def _within(self, name: str) -> str:
        return f"{self.reading.unit.name}.{name}"

    def _followed(
        self, statements: tuple[m.Statement, ...], ranges: Mapping[str, Interval]
    ) -> Body:
        """A body for the analysis; its functions stand in the place of their calls."""
        reading = self.reading
        types = {n: t for n, t in self.types.items() if n not in reading.wide}
        types |= {c.name: c.type for served in self.served for c in served.parameters}
        start, needs = BodyStart.BETWEEN, reading.needs
        return Body("", start, statements, types, needs=needs, arguments=ranges)

    def _types(self) -> dict[str, m.Type]:
        """The state variables with their types."""
        found = {}
        for name, key in self.reading.state.items():
            kind = self.reading.learnt.kind(key)
            if kind in TYPES:
                found[name] = TYPES[kind]
        return found

    # --- servers --------------------------------------------------------------------------------

    def _server(self, server: Server, number: int) -> ReadServer:
        reading = self.reading
        scope = reading.code.scopes[server.cpp.source.path, server.body.id]
        frame = Frame(scope, server=server.name)
        if why := decorated_callback(scope):
            unread = Unread(scope.py.span(scope.node), why)
            reading.findings.unreadable(scope.py.source, unread, reading.unit.name)
        parameters = scope.parameters[1:] if scope.self_name is not None else scope.parameters
        frame.bound |= {p.name: Nobody() for p in parameters}
        if server.message and server.type is not None:
            key = "server", scope.node.id, server.message
            frame.bound[server.message] = Message(key, "", server.type, False, server.name)
        reader = PyStatements(
            reading, frame, self._within(server.name), scope.node, (scope.node.id,)
        )
        statements = without_end(self._body(reader, scope))
        carried = tuple(self._carried(server))
        ranges = dict(self._ranges(server, carried))
        period = reading.periods.get(number)
        fact = server.timers[0] if server.timers else None
        body = m.Block(statements)
        if fact is not None and fact.one_shot is not True and period is not None:
            body = repeated(body, send(server.name, period), takes_time(body))
        switch = switch_of(reading, number)
        if switch is not None:
            body = without_stale(body, switch)
        statements = body.statements
        return ReadServer(server.name, statements, carried, ranges, scope.node)

    def _body(self, reader: PyStatements, scope: Scope) -> tuple[m.Statement, ...]:
        if scope.kind == LAMBDA:
            return tuple(reader.lambda_(field(scope.node, "body")))
        return reader.body(body_of(scope))

    def _carried(self, server: Server) -> Iterator[ParameterField]:
        """The fields that the body reads, in the order of the message."""
        used = self.reading.learnt.used_of(self.reading.unit.name, server.name)
        for path, type_ in (self.reading.types.fields(server.type or "") or {}).items():
            if path not in used or type_ is None:
                continue
            if not self.reading.learnt.is_open(self.reading.unit.name, server.name, path):
                yield ParameterField(path, self.reading.parameter(path), type_)

    def _ranges(
        self, server: Server, carried: Sequence[ParameterField]
    ) -> Iterator[tuple[str, Interval]]:
        types = self.reading.types
        fields = types.fields(server.type or "") or {}
        for each in carried:
            if field_kind(each.type) == WHOLE:
                yield each.name, bounds(fields, types.widths.get(server.type or "", {}), each.path)

    def _loop(self, loop: EndlessLoop) -> ReadServer:
        """The server of a loop, which sends to itself after what it waits at its end."""
        frame = Frame(loop.frame.scope, bound=dict(loop.frame.bound), kept=loop.frame.kept)
        reader = PyStatements(
            self.reading, frame, self._within(loop.name), loop.node, loop.running, only=loop.only
        )
        statements = reader.body(named(field(loop.node, "body")))
        pause: m.Expression | None = None
        match statements[-1:]:
            case (m.ExpressionStatement(m.Call(None, "delay", (time,))),):
                statements, pause = statements[:-1], time
        again = m.ExpressionStatement(m.Call(m.Self(), loop.name, (), pause))
        at_once = m.ExpressionStatement(m.Call(m.Self(), loop.name))
        return ReadServer(loop.name, (*left(statements, at_once), again), node=loop.node)

    # --- the class ------------------------------------------------------------------------------

    def reactive(self, name: str, known: Sequence[tuple[str, str]]) -> m.ReactiveClass:
        """The class of the model, of known rebecs by their names and classes."""
        variables = dict(self.types)
        names = Names(set(variables) | {s.name for s in self.served} | {n for n, _ in known})
        begun = m.Block(tidied(_shown(self.constructor), self.reading.made))
        body, late, more = started_late(tidy(begun, variables), (), names)
        variables |= more
        servers = [*late, *(self._as_server(s, variables) for s in self.served)]
        state = mentioned(variables, [*servers, body])
        members: list[m.ClassMember] = []
        if known:
            members.append(m.KnownRebecs(declarations((n, m.Type(t)) for n, t in known)))
        if state:
            members.append(m.StateVars(declarations(state.items())))
        members.append(m.Constructor(name, (), body))
        unit = self.reading.unit
        first = unit.lineage[0] if unit.lineage else unit.module
        stopped = ((s.name, switch_of(self.reading, n)) for n, s in self.reading.servers.items())
        stale = stale_messages({n: s for n, s in stopped if s is not None}, servers)
        return m.ReactiveClass(
            name,
            self.reading.unit.unit.queue(len(self.loops)) + stale,
            (*members, *servers),
            span=first.py.span(first.node),
        )

    def _as_server(self, served: ReadServer, variables: Mapping[str, m.Type]) -> m.MessageServer:
        body = tidy(m.Block(tidied(_shown(served.statements), self.reading.made)), variables)
        parameters = tuple(m.Parameter(c.type, c.name) for c in served.parameters)
        py = self.reading.unit.module.py
        if served.node is None:
            return m.MessageServer(served.name, parameters, body)
        return m.MessageServer(served.name, parameters, body, span=py.span(served.node))

    def note(self) -> None:
        """Lists what the model does otherwise than the node, as a whole."""
        if not any(takes_time(m.Block(s.statements)) for s in self.served):
            return
        self._note_threads()
        for fact in self.reading.unit.unit.facts:
            if isinstance(fact, TimerFact) and fact.one_shot is not True:
                place = fact.site.place
                self.reading.findings.assumed(
                    place.source, place.span, _BEAT, within=self.reading.unit.name
                )

    def _note_threads(self) -> None:
        """Where other callbacks run while one sleeps, and see the state in the middle of it.

        In rospy all of them do, in rclpy those that callback groups let several threads run.
        """
        reading = self.reading
        alone = reading.unit.library.threads and len(self.served) < 2
        if alone or not runs_in_threads(reading.unit, reading.code):
            return
        for served in self.served:
            if served.node is not None and takes_time(m.Block(served.statements)):
                unread = Unread(reading.unit.module.py.span(served.node), _ASLEEP)
                source = reading.unit.module.py.source
                reading.findings.unreadable(source, unread, reading.unit.name)


def _shown(statements: tuple[m.Statement, ...]) -> tuple[m.Statement, ...]:
    """Without what is only looked at."""

    def change(node: object) -> object:
        if not isinstance(node, m.Block):
            return node
        return replace(node, statements=tuple(s for s in node.statements if not _is_probe(s)))

    return rewritten(m.Block(statements), change).statements


def _is_probe(statement: m.Statement) -> bool:
    match statement:
        case m.ExpressionStatement(_, annotations):
            return any(a.name == PROBE for a in annotations)
        case _:
            return False
