"""Units of hand-written code as reactive classes."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import field, replace
from typing import TypeVar

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.cpp_effects import is_outside
from rebsync.reverse.cpp_expressions import CppExpressions
from rebsync.reverse.cpp_index import Code, CppFunction
from rebsync.reverse.cpp_statements import CppStatements
from rebsync.reverse.cpp_tree import Cpp, text_of
from rebsync.reverse.cpp_types import carried
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import (
    ClientFact,
    PublisherFact,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
)
from rebsync.reverse.message_types import Fields, MessageTypes
from rebsync.reverse.node_loops import Loop, left
from rebsync.reverse.node_reach import unreached
from rebsync.reverse.node_servers import Server
from rebsync.reverse.node_setup import Setup, around, send
from rebsync.reverse.node_starts import Opening, Step, started_late
from rebsync.reverse.node_state import State
from rebsync.reverse.node_tidying import tidy, without_values
from rebsync.reverse.node_units import Unit
from rebsync.reverse.node_views import is_header
from rebsync.reverse.scope import (
    Called,
    Function,
    Inline,
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
from rebsync.source import Span

_Member = TypeVar("_Member", m.MessageServer, m.Method)
_ROUNDS = 4
_BEAT = (
    "a timer that goes off while the node is busy keeps its beat;"
    " the model's goes on from when it is served"
)
_HANDLES = (SubscriptionFact, TimerFact, ServiceFact, ClientFact)


@dataclass(frozen=True, slots=True)
class Common:
    """What all bodies of a package can name: enumerations and message types."""

    enumerators: Mapping[str, int]
    enums: frozenset[str]
    messages: Mapping[str, Fields]
    types: frozenset[str]


@dataclass(slots=True)
class NodeClass:
    """Reads one reactive class: a unit as its rebecs of one kind are wired."""

    code: Code
    name: str
    unit: Unit
    servers: Sequence[Server]
    state: State
    setup: Setup
    types: MessageTypes
    common: Common
    known: Sequence[tuple[str, str]]
    targets: Mapping[int, tuple[Target, ...]]
    opening: Opening
    findings: Findings
    functions: dict[str, Function] = field(default_factory=dict)
    _used: dict[str, CppFunction] = field(default_factory=dict)
    _delays: bool = False

    def read(self) -> m.ReactiveClass:
        """The class. What it has no place for is listed."""
        self._choose_functions()
        body = self._constructor()
        methods = [self._method(n, f) for n, f in self._used.items()]
        self._delays = self._delays or any(_takes_time(method) for method in methods)
        servers = [self._server(s) for s in self.servers]
        servers += [s for loop, name in self.setup.loops for s in self._loop(loop, name)]
        arguments = tuple(m.Parameter(p.type, p.name) for p in self.setup.parameters)
        constructor, late, variables = started_late(
            tidy(body, self.state.variables), arguments, self.setup.names
        )
        variables = {**self.state.variables, **variables}
        servers = [_tidied(s, variables) for s in [*late, *servers]]
        methods = [_tidied(method, variables) for method in methods]
        arguments = self._needed(arguments, constructor)
        self._note_beats()
        self._note_unreached()
        inner: list[m.MessageServer | m.Method] = [*servers, *methods]
        methods = _reached(inner, constructor, methods)
        state = _mentioned(variables, [*servers, *methods, constructor])
        members: list[m.ClassMember] = []
        if self.known:
            members.append(m.KnownRebecs(tuple(_declared(m.Type(t), n) for n, t in self.known)))
        if state:
            members.append(m.StateVars(tuple(_declared(t, n) for n, t in state.items())))
        members.append(m.Constructor(self.name, arguments, constructor))
        members += [*servers, *methods]
        node = self.unit.owner
        span = node.cpp.span(node.node) if node is not None else self._span()
        return m.ReactiveClass(self.name, self._queue(), tuple(members), span=span)

    def _note_beats(self) -> None:
        """Lists the timers of a node that is busy at times."""
        for fact in self.unit.facts:
            if self._delays and isinstance(fact, TimerFact) and fact.one_shot is not True:
                place = fact.site.place
                self.findings.approximated(
                    place.source, place.span, _BEAT, within=self.setup.within
                )

    def _note_unreached(self) -> None:
        """Lists functions that act on what the model has, and that something not read calls."""
        for function in unreached(self.code, self.unit, self.setup.first, self.servers):
            assert function.body is not None
            if not is_outside(function.cpp, self._scope(function.cpp, function), function.body):
                why = "something calls this that is not read: what it does is not in the model"
                name = function.node.child_by_field_name("declarator")
                span = function.cpp.span(name if name is not None else function.node)
                within = self._within(function.name)
                self.findings.unreadable(function.cpp.source, Unread(span, why), within)

    def _needed(self, arguments: tuple[m.Parameter, ...], body: m.Block) -> tuple[m.Parameter, ...]:
        """The parameters that the constructor uses: others only say when a timer goes off."""
        used = {n.name for n in m.walk(body) if isinstance(n, m.Name)}
        self.setup.parameters = [p for p in self.setup.parameters if p.name in used]
        return tuple(a for a in arguments if a.name in used)

    def _span(self) -> Span:
        program = self.unit.program
        assert program is not None
        return program.main.cpp.span(program.main.node)

    def _queue(self) -> int:
        """The largest depth of the subscriptions, and enough for its own timers and loops."""
        facts = self.unit.facts
        depths = [f.depth for f in facts if isinstance(f, SubscriptionFact)]
        known = [d for d in depths if isinstance(d, int) and not isinstance(d, bool)]
        own = sum(isinstance(f, TimerFact) for f in facts) + len(self.setup.loops) + 1
        return max([*known, own + (1 if depths else 0)])

    # --- scopes ---------------------------------------------------------------------------------

    def _scope(self, cpp: Cpp, function: CppFunction | None) -> Scope:
        """What a body in a file, in a function, can name."""
        members: dict[str, Member] = dict(self.state.members_of(function))
        for number, fact in enumerate(self.unit.facts):
            kept = fact.site.kept.removeprefix("this->")
            if isinstance(fact, PublisherFact) and kept:
                type_ = fact.type if isinstance(fact.type, str) else ""
                members[kept] = Publishes(self.targets.get(number, ()), type_)
            elif isinstance(fact, TimerFact) and kept:
                server = next((s for s in self.servers if fact in s.timers), None)
                if server is not None:
                    members[kept] = TimerOf(server.name, fact.one_shot is not True)
            elif kept and isinstance(fact, _HANDLES):
                members[kept] = Outside()
        entry = self.opening.entry
        if entry is not None and function is not None and function.node.id == entry.node.id:
            members |= self.opening.objects
        return Scope(
            members,
            self.functions,
            {},
            self.common.types,
            constants=self.code.constants_for(cpp),
            enumerators=self.common.enumerators,
            enums=self.common.enums,
            messages=self.common.messages,
            timers=self.setup.timers,
            instead=self.setup.instead,
            values=self.setup.values,
            open=True,
            chooses=False,
            unit=self.setup.times.unit,
        )

    def _within(self, name: str) -> str:
        return f"{self.setup.within}.{name}"

    # --- functions ------------------------------------------------------------------------------

    def _choose_functions(self) -> None:
        """Functions become methods where a method can say what they do; others are inlined."""
        by_name: dict[str, list[CppFunction]] = {}
        for function in (*self.unit.functions, *self._free()):
            by_name.setdefault(function.name, []).append(function)
        for above in self.unit.lineage:
            for declared in above.functions:
                by_name.setdefault(declared.name, [])
        served = {s.body.id for s in self.servers}
        methods: dict[str, CppFunction] = {}
        for name, found in by_name.items():
            if name in self.unit.names or name.startswith("~") or name == "main":
                continue
            if len(found) != 1 or found[0].body is None:  # nobody knows which, or what it does
                self.functions[name] = Called(name, server=True)
            elif found[0].body.id in served or (method := self._signature(found[0])) is None:
                self.functions[name] = Inline(found[0])
            else:
                self.functions[name] = method
                methods[name] = found[0]
        self._try(methods)

    def _free(self) -> Iterator[CppFunction]:
        """The functions outside of classes that member functions can call."""
        if self.unit.owner is None:
            return
        near = self.unit.files | {f.cpp.source.path for f in self.setup.first}
        for (owner, _), all_of in self.code.definitions.items():
            for function in all_of:
                here = function.cpp.source.path in near or is_header(function.cpp)
                others = [f for f in all_of if f.cpp.source.path in near]
                if not owner and function.body is not None and (here or not others):
                    yield function

    def _signature(self, function: CppFunction) -> Called | None:
        """A function as a method, if its parameters and result are of the model's types."""
        if self._sets_up(function):
            return None
        takes = []
        for parameter in function.parameters:
            type_ = carried(parameter.type, self.common.enums)
            declarator = parameter.node.child_by_field_name("declarator")
            plain = declarator is not None and declarator.type == "identifier"
            if type_ is None or type_.bits or type_.why or not plain:
                return None
            takes.append(type_.type)
        result = carried(function.result, self.common.enums) if function.result else None
        void = function.result is not None and text_of(function.result) == "void"
        if not void and (result is None or result.bits or result.why):
            return None
        name = self.setup.names.give(function.name)
        returned = result.type if result else None
        return Called(name, takes=tuple(takes), returns=returned, function=function)

    def _sets_up(self, function: CppFunction) -> bool:
        """Whether a function has calls or loops that set the node up."""
        body = function.body
        if body is None:
            return False
        calls = [f.site.call for f in self.setup.facts] + [lo.node for lo, _ in self.setup.loops]
        return any(
            f.cpp is function.cpp and body.start_byte <= c.start_byte < body.end_byte
            for f in [function]
            for c in calls
        )

    def _try(self, methods: dict[str, CppFunction]) -> None:
        """Leaves those methods that can be read as such; a choice is none of a method."""
        findings = self.findings
        for _ in range(_ROUNDS):
            failed = []
            for name, function in methods.items():
                self.findings = Findings()
                self._method(name, function)
                if self.findings.all:
                    failed.append(name)
            self.findings = findings
            for name in failed:
                self.functions[name] = Inline(methods.pop(name))
            if not failed:
                break
        for name in methods:
            self._used[name] = methods[name]

    def _method(self, name: str, function: CppFunction) -> m.Method:
        called = self.functions[name]
        assert isinstance(called, Called)
        scope = self._scope(function.cpp, function)
        local: dict[str, Meaning] = {}
        parameters = []
        for parameter, type_ in zip(function.parameters, called.takes or (), strict=True):
            assert isinstance(type_, m.Type)
            given = scope.local(parameter.name)
            local[parameter.name] = Variable(given, type_)
            parameters.append(m.Parameter(type_, given, function.cpp.span(parameter.node)))
        inside = scope.with_locals(local)
        body = self._read(function.cpp, inside, function.body, self._within(function.name))
        result = called.returns or m.Type("void")
        span = function.cpp.span(function.node)
        return m.Method(result, called.name, tuple(parameters), body, span=span)

    def _read(self, cpp: Cpp, scope: Scope, body: Node | None, within: str) -> m.Block:
        assert body is not None
        return CppStatements(cpp, scope, self.findings, within).block(body)

    # --- servers --------------------------------------------------------------------------------

    def _server(self, server: Server) -> m.MessageServer:
        function = server.callback.function
        if function is None:
            function = around(server.body, self.unit.functions)
        scope = self._scope(server.cpp, function)
        local: dict[str, Meaning] = {}
        for name, value in server.arguments:
            local[name] = self._argument(server.cpp, scope, value)
        if server.message:
            local[server.message] = self._message(server)
        if server.service is not None and function is not None:
            local |= {p.name: Outside() for p in function.parameters if p.name}
        inside = replace(scope.with_locals(local), chooses=True, server=server.name)
        body = self._read(server.cpp, inside, server.body, self._within(server.name))
        body = replace(body, statements=_without_end(without_values(body).statements))
        self._delays = self._delays or _takes_time(body)
        period = self.setup.periodic.get(server.name)
        if server.timers and period is not None:
            body = _repeated(body, send(server.name, period), self._delays)
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
        fields = {p.path: Variable(p.name, p.type) for p in server.parameters}
        return Record(fields, server.type)

    def _loop(self, loop: Loop, name: str) -> Iterator[m.MessageServer]:
        """The server of a loop, and one for what comes after its sleep where both do something."""
        scope = self._scope(loop.function.cpp, loop.function)
        scope = replace(scope, chooses=True, server=name)
        pause = self.setup.pause(loop)
        again = send(name, pause or 0)
        span = loop.function.cpp.span(loop.node)
        reader = CppStatements(loop.function.cpp, scope, self.findings, self._within(name))
        first, rest = reader.read(loop.first), reader.read(loop.rest)
        if loop.first and loop.rest:
            then = self.setup.names.give(f"{name}_rest")
            body = left(first, send(name))
            body = body if pause is None else (*body, send(then, pause))
            yield m.MessageServer(then, (), m.Block((*left(rest, send(name)), send(name))))
        else:
            ends = () if pause is None else (again,)
            body = (*left((*first, *rest), again), *ends)
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

    def _constructor(self) -> m.Block:
        """What runs before the node serves messages."""
        found: list[m.Statement] = []
        for cpp, stores in self.state.initial:
            assert isinstance(stores.value, Node)
            found += self._known(cpp, stores.value, stores)
        for step in self.opening.steps:
            scope = self._scope(step.function.cpp, step.function)
            instead = {**scope.instead, **step.instead}
            given = {p.name: Variable(p.name, p.type) for p in self.setup.parameters}
            scope = replace(scope, instead=instead, chooses=True)
            scope = scope.with_locals({**given, **self._arguments(step)})
            reader = CppStatements(
                step.function.cpp, scope, self.findings, self._within(step.function.name)
            )
            found += reader.read(step.nodes)
        return without_values(m.Block(_without_end(tuple(found))))

    def _arguments(self, step: Step) -> dict[str, Meaning]:
        """What the parameters of a constructor are for the object that is made."""
        found: dict[str, Meaning] = {}
        for parameter in step.function.parameters:
            kept = carried(parameter.type, self.common.enums)
            found[parameter.name] = Outside(kept.type if kept is not None else None)
            if kept is not None and parameter.name in step.arguments:
                cpp, node = step.arguments[parameter.name]
                try:
                    found[parameter.name] = CppExpressions(cpp, self._scope(cpp, None)).read(node)
                except Unread:
                    continue
        return found

    def _known(self, cpp: Cpp, node: Node, stores: Stores) -> tuple[m.Statement, ...]:
        scope = self._scope(cpp, None)
        scope = replace(scope, instead={**scope.instead, node.id: (stores,)})
        bare = {k: v for k, v in scope.instead.items() if k == node.id}
        reader = CppStatements(cpp, replace(scope, instead=bare), Findings(), self.setup.within)
        return reader.read([node])


def _takes_time(node: m.Node) -> bool:
    return any(isinstance(n, m.Call) and n.name == "delay" for n in m.walk(node))


def _tidied(member: _Member, variables: Collection[str]) -> _Member:
    return replace(member, body=tidy(member.body, variables)) if member.body is not None else member


def _declared(type_: m.Type, name: str) -> m.Declaration:
    return m.Declaration(type_, (m.Declarator(name),))


def _repeated(body: m.Block, again: m.Statement, early: bool) -> m.Block:
    """A timer's body with the send that makes it go on: at its end, if all ways lead there.

    Where bodies take time it stands `early`, since a timer goes on from when it went off.
    """
    early = early or any(isinstance(n, m.Return) for n in m.walk(body))
    statements = (again, *body.statements) if early else (*body.statements, again)
    return replace(body, statements=statements)


def _without_end(statements: tuple[m.Statement, ...]) -> tuple[m.Statement, ...]:
    """Without what only ends a function, `return 0;`, and without blocks around all."""
    while statements and isinstance(statements[-1], m.Return):
        statements = statements[:-1]
    return statements


def _reached(
    members: Sequence[m.MessageServer | m.Method], constructor: m.Block, methods: list[m.Method]
) -> list[m.Method]:
    """The methods that servers, the constructor, or such methods call."""
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


def _mentioned(variables: Mapping[str, m.Type], nodes: Sequence[m.Node]) -> dict[str, m.Type]:
    """The variables that some body names."""
    names = set()
    for node in nodes:
        for inner in m.walk(node):
            match inner:
                case m.Name(name) | m.Member(m.Self(), name):
                    names.add(name)
    return {n: t for n, t in variables.items() if n in names}
