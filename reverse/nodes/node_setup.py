"""What sets a node up, in its constructor or in `main`, as statements of the model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field

from tree_sitter import Node

from rebsync import model as m
from rebsync.package import Value
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_timers import SWITCHING, again, started
from rebsync.reverse.bodies.effects.cpp_roots import identifiers_in
from rebsync.reverse.bodies.scope import Outside, Stores, Switch, TimerOf, Variable
from rebsync.reverse.bodies.types.cpp_types import carried
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import (
    ClientFact,
    Fact,
    NodeFact,
    ParameterFact,
    PublisherFact,
    RateFact,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
)
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.nodes.node_copies import list_changed_copies
from rebsync.reverse.nodes.node_loops import (
    NodeLoop,
    behind,
    cancels,
    ended_early,
    has_word,
    later,
    loop_around,
    loops_in,
    served_early,
    served_within,
)
from rebsync.reverse.nodes.node_names import Names
from rebsync.reverse.nodes.node_parameters import ConstructorParameter, asked, list_given_otherwise
from rebsync.reverse.nodes.node_reach import reached
from rebsync.reverse.nodes.node_servers import Server, replaced, share_variable
from rebsync.reverse.nodes.node_state import State
from rebsync.reverse.nodes.node_texts import forgets
from rebsync.reverse.nodes.node_times import Times
from rebsync.reverse.nodes.node_units import UnitFacts
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_declarations import declared_name
from rebsync.reverse.syntax.cpp_enclosing import enclosing_function, enclosing_statement, in_lambda
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, named, text_of

Entry = tuple["m.Statement | Stores | Node", ...]
_PLAIN = (NodeFact, PublisherFact, SubscriptionFact, ServiceFact, ClientFact, RateFact)
_AGAIN = "a timer that is made again stops the one before; in the model both go on"
_ROUND = "messages wait for the next round of this loop; in the model they are served at once"
_CANCELLED = "the executor may be cancelled: what then runs is not read"
_NESTING = frozenset(
    {"if_statement", "while_statement", "for_statement", "switch_statement", "else_clause"}
)


@dataclass(slots=True)
class Setup:
    """What the calls that set a node up stand for, by the ids of their statements.

    `package` are all facts of the package, `facts` those of the unit;
    `first` are the functions that run before the node serves messages. `periodic` gives for each
    server of a timer its period, `switches` what stops and starts it; `parameters` are those of
    the constructor.
    """

    code: Code
    package: UnitFacts
    state: State
    servers: Sequence[Server]
    facts: Sequence[Fact]
    instances: Sequence[Instance]
    first: Sequence[CppFunction]
    times: Times
    findings: Findings
    within: str
    names: Names
    instead: dict[int, Entry] = field(default_factory=dict)
    values: dict[int, m.Expression] = field(default_factory=dict)
    timers: dict[int, TimerOf] = field(default_factory=dict)
    periodic: dict[str, int] = field(default_factory=dict)
    switches: dict[str, Switch] = field(default_factory=dict)
    parameters: list[ConstructorParameter] = field(default_factory=list)
    loops: list[tuple[NodeLoop, str]] = field(default_factory=list)
    running: list[Node] = field(default_factory=list)

    def prepare(self) -> None:
        """Finds it all out."""
        self._captures()
        self._loops()
        # Calls in the files of this unit, or of the programs that run it.
        near = self.state.unit.files | {f.cpp.source.path for f in self.first}
        plain = (*_PLAIN, TimerFact)
        for fact in self.package.of_files(near):
            if isinstance(fact, plain):
                self._plain(fact)
        for fact in self.facts:
            match fact:
                case TimerFact():
                    self._timer(fact)
                case ParameterFact() if self._is_first(fact) and not self._is_repeated(fact):
                    self._parameter(fact)
                case PublisherFact() | SubscriptionFact() if not self._at_once(fact):
                    self._later(fact)
        for function in self.first:
            self._waits(function)
        for function in self.first:
            running = {loop.id for loop in self.running}
            for unread in served_early(function, running, self.instead):
                self.findings.unreadable(function.cpp.source, unread, self.within)

    def _captures(self) -> None:
        """What lambdas use of the function around them lives as long as they do."""
        for server in self.servers:
            list_changed_copies(self.state.unit, server, self.within, self.findings)
            if server.callback.lambda_ is None:
                continue
            function = enclosing_function(server.body, self.state.unit.functions)
            if function is not None:
                mentioned = {text_of(n) for n in identifiers_in(server.body)}
                self.instead |= self.state.outlive(function, mentioned, False)

    def _is_first(self, fact: Fact) -> bool:
        return fact.site.function is not None and any(
            f.node.id == fact.site.function.node.id for f in self.first
        )

    def _is_repeated(self, fact: Fact) -> bool:
        """Whether a call stands in a loop or lambda that runs while the node serves messages."""
        running = {n.id for n in (*self.running, *(s.body for s in self.servers))}
        return any(n.id in running for n in ancestors(fact.site.call))

    def _plain(self, fact: Fact) -> None:
        """A call that asks for something is no statement of the model."""
        statement = enclosing_statement(fact.site.call)
        kinds = ("expression_statement", "declaration", "field_initializer")
        if statement is not None and statement.type in kinds:
            self.instead[statement.id] = ()

    def _later(self, fact: PublisherFact | SubscriptionFact) -> None:
        what = "published" if isinstance(fact, PublisherFact) else "subscribed to"
        why = f"what is {what} later, or only sometimes, is so from the start in the model"
        place = fact.site.place
        self.findings.assumed(place.source, place.span, why, within=self.within)

    def _at_once(self, fact: Fact) -> bool:
        """Whether a call is made once, when the node starts."""
        around = ancestors(fact.site.call, lambda n: n.type == "function_definition")
        if any(n.type in _NESTING or n.type == "lambda_expression" for n in around):
            return False
        function = fact.site.function
        return self._is_first(fact) or (function is not None and function.name == "main")

    def _timer(self, fact: TimerFact) -> None:
        if fact in replaced(self.facts):
            self._plain(fact)
            return
        server = next((s for s in self.servers if fact in s.timers), None)
        call = fact.site.call
        if server is None:
            why = "it is not known which function the timer calls"
            self._listed(fact, why)
            return
        periodic = fact.one_shot is not True
        self.timers[call.id] = TimerOf(server.name, periodic)
        kept = fact.site.kept.removeprefix("this->")
        if fact.one_shot not in (True, False):
            self._listed(fact, "it is not known whether the timer goes on")
        within = f"{self.within}.{server.name}"
        period = self.times.units(fact, self.instances, self.findings, within)
        if period is not None and periodic:
            self.periodic[server.name] = period
        at_start = self._is_first(fact) or self._at_once(fact)
        alone = fact.one_shot is False or server.timers == (fact,)
        if period is not None and at_start and alone and self._is_switched(fact):
            variables = self.state.switch(kept, not periodic)
            self.switches[server.name] = Switch(*variables[:2], period, variables[2])
        statement = enclosing_statement(call)
        if statement is None or not at_start:
            if statement is not None:
                self.instead.pop(statement.id, None)
            return
        self.instead[statement.id] = ()
        others = [f for f in self.facts if isinstance(f, TimerFact) and share_variable(fact, f)]
        stopped = self.switches.get(server.name)
        is_again = self._is_again(fact) and stopped is None
        if is_again or any(f not in replaced(self.facts) for f in others):
            place = fact.site.place
            self.findings.assumed(place.source, place.span, _AGAIN, within=within)
        if fact.autostart is True and period is not None:
            starts: tuple[m.Statement, ...] = (send(server.name, period),)
            if stopped is not None:
                remade = tuple(again(server.name, stopped))
                starts = remade if self._is_again(fact) else (*started(stopped), *starts)
            self.instead[statement.id] = starts
        elif fact.autostart not in (True, False):
            self._listed(fact, "it is not known whether the timer starts at once")

    def _is_switched(self, fact: TimerFact) -> bool:
        """Whether bodies stop or start a timer that alone has its variable, or make it anew."""
        kept = fact.site.kept.removeprefix("this->")
        others = [f for f in self.facts if isinstance(f, TimerFact) and share_variable(fact, f)]
        if not kept.isidentifier() or any(f not in replaced(self.facts) for f in others):
            return False
        calls = (c for f in self.state.unit.functions for c in self.code.calls_of(f))
        own = (c for c in calls if c.on.removeprefix("this->") == kept and not c.arguments)
        return self._is_again(fact) or any(c.name in SWITCHING for c in own)

    def _is_again(self, fact: TimerFact) -> bool:
        """Whether a timer may be made while it is still running: by what a server calls."""
        function = fact.site.function
        served = reached(self.code, self.state.unit, (), self.servers)
        return function is not None and function.node.id in served

    def _listed(self, fact: Fact, why: str, hint: str = "") -> None:
        place = fact.site.place
        self.findings.unreadable(place.source, Unread(place.span, why, hint), self.within)

    # --- parameters -----------------------------------------------------------------------------

    def _parameter(self, fact: ParameterFact) -> None:
        list_given_otherwise(fact, self.facts, self._listed)
        statement = enclosing_statement(fact.site.call)
        found = asked(fact, self.instances, lambda n: self._type(n, fact), self.facts)
        if found is None or statement is None:
            if statement is not None and statement.type == "expression_statement":
                self.instead[statement.id] = ()
            return
        whole = statement.type == "expression_statement" and _is_call(statement, fact.site.call)
        before = self.instead.get(statement.id, (statement,))
        stores = self._stores(fact, found.target, found.type, found.values)
        is_set = found.found or fact.default is not None
        is_open = found.target is not None and not stores and (is_set or found.found is None)
        if is_open and not forgets(self.state, fact.site.function, found.target, found.type):
            self._listed(fact, "the value of this parameter is not known")
        if found.target is not None and is_set:
            before = (*stores, *before)
        if whole:
            before = tuple(b for b in before if b is not statement)
        elif found.target is None and stores:
            first = stores[0]
            assert isinstance(first, Stores) and isinstance(first.value, m.Name)
            self.values[fact.site.call.id] = first.value
        elif found.found is not None:
            self.values[fact.site.call.id] = m.BoolLiteral(found.found)
        if whole or before != (statement,):
            self.instead[statement.id] = before

    def _stores(
        self,
        fact: ParameterFact,
        target: Node | None,
        type_: m.Type | None,
        values: tuple[Value | None, ...],
    ) -> tuple[Stores, ...]:
        """The new parameter of the constructor, stored where it belongs."""
        if type_ is None or not isinstance(fact.name, str) or (None in values and self.instances):
            return ()
        wish = fact.name.rpartition("/")[2].lstrip("~").replace(".", "_") or "value"
        free = [w for w in (wish, f"{wish}_given") if w not in self.state.taken]
        name = self.names.give(*free, f"{wish}_value")
        self.parameters.append(ConstructorParameter(name, type_, values))
        return (Stores(target if target is not None else fact.site.call, m.Name(name)),)

    def _type(self, target: Node, fact: ParameterFact) -> m.Type | None:
        """The type of the variable that a parameter is stored in; None for one outside."""
        name = text_of(target).removeprefix("this->")
        members = self.state.members_of(fact.site.function)
        match members.get(name):
            case Variable(_, type_):
                return type_
            case Outside():
                return None
        body = fact.site.function.body if fact.site.function is not None else None
        for node in inside(body, "declaration"):
            for declarator in node.children_by_field_name("declarator"):
                inner = declarator.child_by_field_name("declarator")
                found = declared_name(inner if inner is not None else declarator)
                type_node = node.child_by_field_name("type")
                if found is not None and text_of(found) == name and type_node is not None:
                    kept = carried(type_node, self.state.enums)
                    return kept.type if kept is not None else None
        return None

    # --- loops and waiting ----------------------------------------------------------------------

    def _loops(self) -> None:
        rates = [f for f in self.facts if isinstance(f, RateFact)]
        for function in self.first:
            for loop in loops_in(function, rates):
                self.running.append(loop.node)
                self._loop(function, loop)

    def _loop(self, function: CppFunction, loop: NodeLoop) -> None:
        parts = (*loop.first, *loop.rest)
        self.instead[loop.node.id] = ()
        if (
            self.servers
            and has_word(loop.node, libraries.serving_once())
            and (loop.rate is not None or loop.sleeps)
        ):
            source, span = function.cpp.source, function.cpp.span(loop.node)
            if loop.rate is not None:
                source, span = loop.rate.site.place.source, loop.rate.site.place.span
            self.findings.assumed(source, span, _ROUND, within=self.within)
        for middle in served_within(loop) if self.servers else ():
            self.findings.unreadable(function.cpp.source, middle, self.within)
        if parts:
            mentioned = {text_of(n) for p in parts for n in identifiers_in(p)}
            self.instead |= self.state.outlive(function, mentioned, False, loop.node)
            self.instead[loop.node.id] = ()
            plain = function.name not in ("main", function.owner)  # no constructor
            name = self.names.give(function.name if plain else "loop")
            self.loops.append((loop, name))
            period = self._pause(loop) if not loop.first else 0
            self.instead[loop.node.id] = (send(name, period or 0),)
        for after, unread in behind(loop):
            self.instead[after.id] = ()
            if unread is not None:
                self.findings.unreadable(function.cpp.source, unread, self.within)

    def _pause(self, loop: NodeLoop) -> int | None:
        """The time that a loop sleeps in each round, in units."""
        if loop.rate is None:
            return None
        return self.times.units(loop.rate, self.instances, self.findings, self.within)

    def pause(self, loop: NodeLoop) -> int | None:
        """The time between two rounds of a loop, in units; None, and listed, where it is open."""
        if loop.rate is not None:
            return self._pause(loop)
        if not loop.sleeps:
            why = "this loop runs as often as the machine can: the model cannot say how often"
            unread = Unread(loop.function.cpp.span(loop.node), why, "let it sleep by a rate")
            self.findings.unreadable(loop.function.cpp.source, unread, self.within)
            return None
        return 0

    def _waits(self, function: CppFunction) -> None:
        """What waits for messages, or lets ROS serve them, is nothing in the model."""
        words = libraries.waiting() | libraries.named(Kind.AUDIENCE)
        waits = function.body is not None and has_word(function.body, words)
        for call in self.code.calls_of(function) if waits else ():
            name = call.name.rpartition("::")[2]
            is_asked = name in libraries.named(Kind.AUDIENCE)
            if is_asked and (loop := loop_around(call.node)) is not None:
                self.instead[loop.id] = ()
                continue
            statement = enclosing_statement(call.node) if name in libraries.waiting() else None
            if statement is None or not _is_call(statement, call.node):
                continue
            own = call.target is None and "::" not in call.name
            if statement.type != "expression_statement" or own or statement.id in self.instead:
                continue
            is_other = name == "start" and "pinner" not in call.on.lower()
            if is_other or (name in libraries.named(Kind.SHUTDOWN) and in_lambda(call.node)):
                continue
            if call.target is not None and any(f.name == name for f in self.state.unit.functions):
                continue
            self.instead[statement.id] = ()
            if name in libraries.named(Kind.SPIN):
                if (
                    call.target is not None
                    and cancels(self.code, (*self.state.unit.functions, function), self.facts)
                    and ended_early(statement, self.instead)
                ):
                    unread = Unread(function.cpp.span(call.node), _CANCELLED)
                    self.findings.unreadable(function.cpp.source, unread, self.within)
                for after in later(statement):
                    self.instead[after.id] = ()


def send(server: str, after: int = 0) -> m.Statement:
    """`self.server() after(...)`."""
    return m.ExpressionStatement(
        m.Call(m.Self(), server, (), m.IntLiteral(after) if after else None)
    )


def _is_call(statement: Node, call: Node) -> bool:
    """Whether a statement is nothing but a call."""
    inner = named(statement)
    return len(inner) == 1 and inner[0].id == call.id
