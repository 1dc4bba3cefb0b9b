"""Bodies of a unit as those of message servers and of a constructor."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field, replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_expressions import CppExpressions
from rebsync.reverse.bodies.cpp_statements import CppStatements
from rebsync.reverse.bodies.effects.calm import Calm, Sure
from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.bodies.effects.cpp_regions import Regions
from rebsync.reverse.bodies.scope import (
    Function,
    Lambda,
    Meaning,
    Member,
    Outside,
    Publishes,
    Record,
    Scope,
    Stores,
    Target,
    TimerOf,
    Variable,
)
from rebsync.reverse.bodies.serving import Serves
from rebsync.reverse.bodies.types.cpp_types import carried
from rebsync.reverse.build.message_types import Fields
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import (
    ClientFact,
    PublisherFact,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
)
from rebsync.reverse.nodes.node_defaults import DefaultValues, ordered_defaults
from rebsync.reverse.nodes.node_held import Held, held
from rebsync.reverse.nodes.node_kept import elements
from rebsync.reverse.nodes.node_loops import NodeLoop, left
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_setup import Setup, send
from rebsync.reverse.nodes.node_signatures import Signatures
from rebsync.reverse.nodes.node_starts import Opening, StartStatements
from rebsync.reverse.nodes.node_state import State
from rebsync.reverse.nodes.node_tidying import without_values
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_enclosing import enclosing_function
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of

_SERVING = (SubscriptionFact, ServiceFact)
_HANDLES = (TimerFact, ClientFact)


@dataclass(frozen=True, slots=True)
class Common:
    """What all bodies of a package can name: enumerations, message types and functions."""

    enumerators: Mapping[str, int | str]
    enums: frozenset[str]
    messages: Mapping[str, Fields]
    types: frozenset[str]
    signatures: Signatures
    _forms: dict[int, CppForm] = field(default_factory=dict, repr=False)

    def form(self, code: Code) -> CppForm:
        """The intermediate form of some of its files."""
        return self._forms.setdefault(id(code), CppForm(code))


@dataclass(slots=True)
class Bodies:
    """Reads the bodies of a unit, as its rebecs of one kind are wired.

    `functions` are the methods and what else it can call; `overflowing` are state variables that
    hold more in the code than an `int` does, `wide` the bits of locals that could. `changed_texts`
    are variables of texts, by their names in the model, that get other texts than the model knows.
    """

    code: Code
    unit: Unit
    servers: Sequence[Server]
    state: State
    setup: Setup
    common: Common
    targets: Mapping[int, tuple[Target, ...]]
    opening: Opening
    findings: Findings
    functions: dict[str, Function] = field(default_factory=dict)
    overflowing: frozenset[str] = frozenset()
    regions: dict[str, Regions] = field(default_factory=dict)
    wide: dict[str, int] = field(default_factory=dict)
    changed_texts: set[str] = field(default_factory=set)
    lowered: set[m.Expression] = field(default_factory=set)
    sure: Sure = field(default_factory=Sure)
    calls: dict[int, CppCall] = field(default_factory=dict)
    # What is made when it is first asked for, once the node is set up.
    _held: tuple[Held, ...] | None = None
    _kept: dict[str, Member] | None = None

    def scope(
        self,
        cpp: Cpp,
        function: CppFunction | None,
        *,
        chooses: bool = False,
        server: str | None = None,
        instead: Mapping[int, tuple[m.Statement | Stores | Node, ...]] | None = None,
        local: Mapping[str, Meaning] | None = None,
    ) -> Scope:
        """What a body in a file, in a function, can name; see `Scope` for what it may be given.

        What stands for statements `instead` is what the set-up says, unless it is given.
        """
        members = {**self.state.members_of(function), **self._own_members()}
        entry = self.opening.entry
        if entry is not None and function is not None and function.node.id == entry.node.id:
            members |= self.opening.objects
        return Scope(
            members,
            self.functions,
            {},
            self.common.types,
            locals=local if local is not None else {},
            constants=self.code.constants_for(cpp),
            enumerators=self.common.enumerators,
            enums=self.common.enums,
            messages=self.common.messages,
            widths=self.state.types.widths,
            overflowing=self.overflowing,
            regions=self._regions(cpp).of,
            wide=self.wide,
            changed_texts=self.changed_texts,
            lowered=self.lowered,
            calm=Calm(self.sure),
            calls=self.calls,
            macros=self.code.macros,
            timers=self.setup.timers,
            instead=instead if instead is not None else self.setup.instead,
            values=self.setup.values,
            open=True,
            chooses=chooses,
            server=server,
            unit=self.setup.times.unit,
            form=self.common.form(self.code),
        )

    def _own_members(self) -> Mapping[str, Member]:
        """What the unit keeps of what it asks ROS for, and the functions that members hold."""
        if self._kept is None:
            self._kept = self._asked_for() | self._in_containers()
            held = self.held()
            self._kept |= {h.name: Lambda(h.lambda_, None) for h in held if h.lambda_ is not None}
        return self._kept

    def _asked_for(self) -> dict[str, Member]:
        """The publishers, timers and other handles that are kept in variables."""
        members: dict[str, Member] = {}
        published: dict[str, Publishes] = {}
        for number, fact in enumerate(self.unit.facts):
            kept = fact.site.kept.removeprefix("this->")
            if isinstance(fact, PublisherFact) and kept.isidentifier():
                type_ = fact.type if isinstance(fact.type, str) else ""
                made = Publishes(self.targets.get(number, ()), type_)
                first = published.setdefault(kept, made)
                same = first is made or first == made
                members[kept] = made if same else Outside()  # one of several
            elif isinstance(fact, TimerFact) and kept:
                server = next((s for s in self.servers if fact in s.timers), None)
                if server is not None:
                    switch = self.setup.switches.get(server.name)
                    members[kept] = TimerOf(server.name, fact.one_shot is not True, switch)
            elif kept and isinstance(fact, _SERVING):
                members[kept] = Serves()
            elif kept and isinstance(fact, _HANDLES):
                members[kept] = Outside()
        return members

    def held(self) -> tuple[Held, ...]:
        """The functions that members hold."""
        if self._held is None:
            fields = [f for c in self.unit.lineage for f in c.fields]
            typed = ((f.name, f.type) for f in fields)
            self._held = tuple(held(typed, self.setup.first, self.code.files))
        return self._held

    def _in_containers(self) -> dict[str, Publishes]:
        """The publishers in maps and vectors, by their places there."""
        facts = {n: f for n, f in enumerate(self.unit.facts) if isinstance(f, PublisherFact)}
        kept = {n: f for n, f in facts.items() if f.site.kept}
        return {
            place: Publishes(self.targets.get(n, ()), f.type if isinstance(f.type, str) else "")
            for place, n in elements(kept, self.code.files).items()
            for f in (facts[n],)
        }

    def _regions(self, cpp: Cpp) -> Regions:
        """What stands for values that nobody knows."""
        path = cpp.source.path
        if path not in self.regions:
            members = self.state.members.items()
            names = {v.name: name for name, v in members if isinstance(v, Variable)}
            constants = self.code.constants_for(cpp)
            values = self.common.enumerators
            self.regions[path] = Regions(self.code.files, names, values, constants)
        return self.regions[path]

    def unread(self, cpp: Cpp, node: Node, why: str, hint: str = "") -> None:
        """Lists a place of the unit that the model lacks."""
        self.findings.unreadable(cpp.source, Unread(cpp.span(node), why, hint), self.unit.name)

    def within(self, name: str) -> str:
        """The name of a body in findings."""
        return f"{self.setup.within}.{name}"

    def block(self, cpp: Cpp, scope: Scope, body: Node | None, within: str) -> m.Block:
        """The body of a function."""
        assert body is not None
        return CppStatements(cpp, scope, self.findings, within).block(body)

    # --- servers --------------------------------------------------------------------------------

    def server(self, server: Server) -> m.MessageServer:
        """A callback as a message server."""
        function = server.callback.function
        if function is None:
            function = enclosing_function(server.body, self.unit.functions)
        local: dict[str, Meaning] = {}
        if server.arguments:
            scope = self.scope(server.cpp, function)
            for name, value in server.arguments:
                local[name] = self._argument(server.cpp, scope, value)
        if server.message:
            local[server.message] = self._message(server)
        if server.service is not None and function is not None:
            local |= {p.name: Outside() for p in function.parameters if p.name}
        inside = self.scope(server.cpp, function, chooses=True, server=server.name, local=local)
        body = self.block(server.cpp, inside, server.body, self.within(server.name))
        body = replace(body, statements=without_end(without_values(body).statements))
        parameters = tuple(m.Parameter(p.type, p.name) for p in server.parameters)
        span = server.cpp.span(function.node if function is not None else server.body)
        return m.MessageServer(server.name, parameters, body, span=span)

    def _argument(self, cpp: Cpp, scope: Scope, value: Node) -> Meaning:
        """What a bind puts in for a parameter: a member, or a value."""
        meaning = scope.meaning(text_of(value).removeprefix("this->").strip("&"))
        if meaning is not None:
            return meaning
        try:
            return CppExpressions(cpp, scope).read(value)
        except Unread:
            return Outside()

    def _message(self, server: Server) -> Member:
        if server.timers or server.type is None:
            return Outside()
        given = [(p.path, p.name, p.type) for p in server.parameters]
        variable = self.state.types.variable
        return Record({p: variable(server.type, p, n, t) for p, n, t in given}, server.type)

    def loop(self, loop: NodeLoop, name: str) -> Iterator[m.MessageServer]:
        """The server of a loop, and one for what comes after its sleep where both do something."""
        scope = self.scope(loop.function.cpp, loop.function, chooses=True, server=name)
        pause = self.setup.pause(loop)
        again = send(name, pause or 0)
        span = loop.function.cpp.span(loop.node)
        reader = CppStatements(loop.function.cpp, scope, self.findings, self.within(name))
        first, rest = reader.read(loop.first), reader.read(loop.rest)
        if loop.first and loop.rest:
            then = self.setup.names.give(f"{name}_rest")
            body = left(first, send(name))
            body = body if pause is None else (*body, send(then, pause))
            yield m.MessageServer(then, (), m.Block((*left(rest, send(name)), send(name))))
        else:
            ends = () if pause is None else (again,)
            next_ = send(name) if loop.first else again  # what goes on skips a sleep behind it
            body = (*left((*first, *rest), next_), *ends)
        for guard in reversed(loop.guard):
            condition = self._guard(reader, guard)
            body = (m.If(condition, m.Block(body)),)
        yield m.MessageServer(name, (), m.Block(body), span=span)

    def _guard(self, reader: CppStatements, node: Node) -> m.Expression:
        """A condition besides that the node runs; it may go either way where it is not known."""
        try:
            return reader.expressions.condition(node)
        except Unread as unread:
            self.findings.unreadable(reader.cpp.source, unread, reader.within)
            return m.Choice((m.BoolLiteral(True), m.BoolLiteral(False)), reader.cpp.span(node))

    # --- constructor ----------------------------------------------------------------------------

    def constructor(self) -> m.Block:
        """What runs before the node serves messages."""
        found: list[m.Statement] = []
        defaults = ordered_defaults(self.state)
        later = {id(each) for values in defaults.values() for each in values}
        found += self._first([each for each in self.state.initial if id(each) not in later])
        given = {p.name: Variable(p.name, p.type) for p in self.setup.parameters}
        for step in self.opening.steps:
            if isinstance(step, DefaultValues):
                for name in step.members:
                    found += self._first(defaults.get((step.owner, name), ()))
                continue
            if not step.nodes:
                continue
            scope = self.scope(
                step.function.cpp,
                step.function,
                chooses=True,
                instead={**self.setup.instead, **step.instead},
                local={**given, **self._arguments(step)},
            )
            reader = CppStatements(
                step.function.cpp, scope, self.findings, self.within(step.function.name)
            )
            found += reader.read(step.nodes)
        return without_values(m.Block(without_end(tuple(found))))

    def _first(self, initial: Sequence[tuple[Cpp, Stores]]) -> Iterator[m.Statement]:
        """What variables hold before code runs that gives them other values."""
        for cpp, stores in initial:
            match stores:
                case Stores(m.Name() as place, m.BoolLiteral() as value):
                    yield m.ExpressionStatement(m.Assign("=", place, value))
                case Stores(_, Node() as value):
                    yield from self._known(cpp, value, stores)

    def _arguments(self, step: StartStatements) -> dict[str, Meaning]:
        """What the parameters of a constructor are for the object that is made."""
        found: dict[str, Meaning] = {}
        for parameter in step.function.parameters:
            kept = carried(parameter.type, self.common.enums)
            found[parameter.name] = Outside(kept.type if kept is not None else None)
            if kept is not None and parameter.name in step.arguments:
                cpp, node = step.arguments[parameter.name]
                try:
                    found[parameter.name] = CppExpressions(cpp, self.scope(cpp, None)).read(node)
                except Unread:
                    continue
        return found

    def _known(self, cpp: Cpp, node: Node, stores: Stores) -> tuple[m.Statement, ...]:
        inside = self.scope(cpp, None, instead={node.id: (stores,)})
        reader = CppStatements(cpp, inside, self.findings, self.setup.within)
        return reader.read([node])


def takes_time(node: m.Node) -> bool:
    """Whether a body waits."""
    return any(isinstance(n, m.Call) and n.name == "delay" for n in m.walk(node))


def repeated(body: m.Block, again: m.Statement, early: bool) -> m.Block:
    """A timer's body with the send that makes it go on: at its end, if all ways lead there.

    Where bodies take time it stands `early`, since a timer goes on from when it went off.
    """
    early = early or any(isinstance(n, m.Return) for n in m.walk(body))
    statements = (again, *body.statements) if early else (*body.statements, again)
    return replace(body, statements=statements)


def without_end(statements: tuple[m.Statement, ...]) -> tuple[m.Statement, ...]:
    """Without what only ends a function, `return 0;`, and without blocks around all."""
    while statements and isinstance(statements[-1], m.Return):
        statements = statements[:-1]
    return statements
