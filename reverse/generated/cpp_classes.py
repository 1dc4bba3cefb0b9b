"""Classes of generated code as reactive classes and interfaces."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field, replace
from fractions import Fraction
from functools import partial

from rebsync import model as m
from rebsync.names import carry, uncarry
from rebsync.records import dataclass
from rebsync.reserved import NO_CLASSES, RESERVED
from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.bodies.overloads import Served
from rebsync.reverse.bodies.runtime_part import runtime_part
from rebsync.reverse.bodies.scope import Around, Called, Function, Ignored, Member, Scope
from rebsync.reverse.bodies.types.cpp_types import class_name
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.generated.cpp_annotations import (
    annotations_in,
    class_annotations,
    server_annotations,
)
from rebsync.reverse.generated.cpp_beside import Beside
from rebsync.reverse.generated.cpp_bodies import GeneratedBodies
from rebsync.reverse.generated.cpp_hand import as_by_hand, is_passive, only_logs, stands_in
from rebsync.reverse.generated.cpp_handed import as_handed_on
from rebsync.reverse.generated.cpp_inherited import is_declared, list_hiding, only_forwards
from rebsync.reverse.generated.cpp_meanings import Meaning, in_files_of, other_meanings
from rebsync.reverse.generated.cpp_mixins import functions_beside, methods_beside, without_mixins
from rebsync.reverse.generated.cpp_names import (
    aliases,
    called,
    declared_type,
    enumerators,
    has_mailbox,
    is_abstract,
    is_given,
    is_interface,
    narrow_enums,
    plain_name,
    runtime_of,
    state_types,
    stored_in,
    variable_name,
)
from rebsync.reverse.generated.cpp_plumbing import check_plumbing
from rebsync.reverse.generated.cpp_posts import learn_servers, posts_in_bodies
from rebsync.reverse.generated.cpp_publishing import meaning_of
from rebsync.reverse.generated.cpp_roles import Roles, roles_of, shown_of
from rebsync.reverse.generated.cpp_sends import add_sends, families_of
from rebsync.reverse.generated.cpp_timers import (
    Timer,
    checked,
    server_of_timer,
    ticking,
    timers_of,
)
from rebsync.reverse.generated.cpp_values import initial_values
from rebsync.reverse.generated.own_parameters import with_own
from rebsync.reverse.generated.receivers import known_rebecs
from rebsync.reverse.generated.ros2_words import is_of_ros
from rebsync.reverse.generated.slicing.members import add_silent
from rebsync.reverse.generated.slicing.publishers import shown_only
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import text_of

_PLUMBING = frozenset({"mailbox", "publishState"})


@dataclass(slots=True)
class Classes:
    """Reads the classes of some code that have a mailbox, and the interfaces of these.

    `messages` are the fields of message types (`package/Type`), `signed` those that say who sends
    them, `unit` the seconds of a unit of time, `served` what classes in another language serve.
    `shown` are types with topics that nobody hears, if no other language has to do with them.
    """

    code: Code
    findings: Findings
    messages: Mapping[str, Mapping[str, m.Type | None]] = field(default_factory=dict)
    unit: Fraction = Fraction(1)
    served: Served = field(default_factory=Served)
    types: frozenset[str] = frozenset()
    roles: dict[str, Roles] = field(default_factory=dict)
    timers: dict[str, tuple[Timer, ...]] = field(default_factory=dict)
    fields: dict[str, Mapping[str, m.Type | None]] = field(default_factory=dict)
    meanings: tuple[Meaning, ...] = ()
    alone: bool = False
    signed: frozenset[str] = frozenset()
    shown: frozenset[tuple[str, str]] = frozenset()
    form: CppForm = field(init=False)
    _scopes: dict[str, Scope] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.types = frozenset(self.code.classes)
        is_generated = any("Mailbox" in cpp.source.text for cpp in self.code.files)
        self.code = without_mixins(self.code) if is_generated else self.code
        self.form = CppForm(self.code, runtime_part(self.code, is_generated))
        if not is_generated:
            self.roles = {name: Roles() for name in self.code.classes}
            return
        self.meanings = other_meanings(self.code)
        self.shown = shown_only(self.code) if self.alone else frozenset()
        classes, given = self.code.classes.values(), (self.messages, self.served)
        self.roles |= {owner.name: roles_of(self.code, owner) for owner in classes}
        for owner in classes:
            add_silent(self.code, self.form, owner, self.roles[owner.name], self.shown)
        self.messages, self.served = as_handed_on(self.code, *given, self.roles)
        self.fields = {t.rpartition("/")[2]: f for t, f in self.messages.items()}
        self.types |= {carry(name, NO_CLASSES) for name in self.served.classes}  # of Python
        self.served = self.served.joined(families_of(self.code, self.roles))
        sent = (p.message for roles in self.roles.values() for p in roles.publishers.values())
        states = (s for c in classes for s in state_types(self.code, c))
        self.types = self.types.union(self.fields, self.served.servers, sent, states)
        for owner in classes:
            learn_servers(self.code, owner, self.roles, self.types)
        for owner in classes:
            add_sends(self.code, owner, self.roles, self.fields, self.served, self.signed)
        self.timers |= {owner.name: tuple(self._timed(owner)) for owner in classes}

    def read(self, wanted: set[str] | None = None) -> tuple[m.ReactiveClass | m.Interface, ...]:
        """All of them, or those that are wanted, in the order of the code."""
        return tuple(map(self.read_one, self.chosen(wanted)))

    def chosen(self, wanted: set[str] | None = None) -> Iterator[CppClass]:
        """The classes of the model among those of the code, or those of them that are wanted."""
        for owner in self.code.classes.values():
            of_model = has_mailbox(self.code, owner) or is_interface(owner, alone=not self.timers)
            if of_model and (wanted is None or owner.name in wanted):
                yield owner

    def read_one(self, owner: CppClass) -> m.ReactiveClass | m.Interface:
        """One of them; what cannot be read is listed."""
        return self._reactive(owner) if has_mailbox(self.code, owner) else self._interface(owner)

    def _timed(self, owner: CppClass) -> Iterator[Timer]:
        """The timers of a class; their callbacks are servers, unless they only post a message."""
        roles = self.roles[owner.name]
        for timer in timers_of(self.code, owner, roles) if has_mailbox(self.code, owner) else ():
            if timer.posts is None and timer.at_start and self._is_idle(owner, timer):
                continue
            if timer.callback and timer.one_shot and timer.posts is not None:
                roles.passing.add(timer.callback)
            elif timer.callback:
                roles.handlers[timer.callback] = uncarry(timer.callback, RESERVED | self.types)
            yield timer

    def _is_idle(self, owner: CppClass, timer: Timer) -> bool:
        """Whether what a timer calls touches nothing of the model, as what logs does."""
        scope = as_by_hand(self.code, owner, self.shown, self._scope(owner))
        return Beside.of(self.code, timer.function, scope).is_idle_timer(timer.call)

    # --- one class ------------------------------------------------------------------------------

    def _interface(self, owner: CppClass) -> m.Interface:
        servers = tuple(
            self._server(owner, f, plain_name(f, self.types))
            for f in self.code.functions_of(owner)
            if f.pure
        )
        extends, notes = map(class_name, owner.bases), annotations_in(owner.markers, owner)
        span = owner.cpp.span(owner.node)
        return m.Interface(class_name(owner.name), servers, tuple(extends), notes, span)

    def _reactive(self, owner: CppClass) -> m.ReactiveClass:
        roles = self.roles[owner.name]
        by_hand = partial(self._by_hand, owner)
        given = self.roles, self.fields, by_hand, self.findings
        check_plumbing(self.code, self.form, owner, *given)
        for meaning in self.meanings:
            if in_files_of(self.code, owner, meaning):
                unread = Unread(meaning.cpp.span(meaning.node), meaning.why)
                self.findings.unreadable(meaning.cpp.source, unread, owner.name)
        for timer in self.timers[owner.name]:
            checked(timer, f"{owner.name}.{timer.function.name}", self.findings)
        functions = (f for f in self.code.functions_of(owner) if self._is_of_model(owner, f))
        known, state = self._variables(owner)
        members: list[m.ClassMember] = [m.KnownRebecs(tuple(known))] if known else []
        members += [m.StateVars(tuple(state))] if state else []
        own, name = stored_in(self.code, roles, owner), class_name(owner.name)
        members += with_own(tuple(self._constructors(owner)), own, name)
        served = [(f, self._served(owner, f)) for f in functions]
        members += [self._server(owner, f, by) for f, by in served if by is not None]
        members += self._lambdas(owner)
        members += [self._method(owner, f) for f, by in served if by is None]
        members += [self._method(owner, f) for f in methods_beside(self.code, owner)]
        classes = self.code.classes
        extends = [b for b in owner.bases if b in classes and has_mailbox(self.code, classes[b])]
        return m.ReactiveClass(
            name,
            (roles.queue_length or 1) + ticking(self.timers[owner.name]),
            tuple(members),
            is_abstract(owner),
            class_name(extends[0]) if extends else None,
            tuple(class_name(b) for b in owner.bases if b not in extends),
            tuple(class_annotations(self.roles, owner)),
            owner.cpp.span(owner.node),
        )

    def _by_hand(self, owner: CppClass) -> Scope:
        return as_by_hand(self.code, owner, self.shown, self.scope(owner))

    # --- variables ------------------------------------------------------------------------------

    def _variables(self, owner: CppClass) -> tuple[list[m.Declaration], list[m.Declaration]]:
        roles = self.roles[owner.name]
        known: list[m.Declaration] = []
        state: list[m.Declaration] = []
        others = roles.globals.keys() | roles.odd_globals | roles.silent
        spans = {f.name: f.cpp.span(f.node) for f in owner.fields}
        for member in owner.fields:
            if runtime_of(member) or member.name in others:
                continue
            type_ = declared_type(self.code, member.type)
            if type_ is None:
                if not is_of_ros(text_of(member.type)) and not is_passive(text_of(member.type)):
                    why = f'the model has no type "{text_of(member.type)}"'
                    unread = Unread(spans[member.name], why)
                    self.findings.unreadable(member.cpp.source, unread, owner.name)
                continue
            span = spans[member.name]
            declarator = m.Declarator(variable_name(roles, member), None, span)
            notes = annotations_in(member.markers, owner)
            kind = known if member.name in roles.known else state
            kind.append(m.Declaration(type_, (declarator,), notes, span))
        above = (self.roles[c.name].receivers for c in self.code.lineage(owner.name)[1:])
        return known_rebecs(known, state, roles.receivers, spans, above), state

    # --- functions ------------------------------------------------------------------------------

    def _is_of_model(self, owner: CppClass, function: CppFunction) -> bool:
        roles = self.roles[owner.name]
        if function.name in (owner.name, f"~{owner.name}", "construct") or is_given(function):
            return False
        plain = roles.shims | roles.passing | set(roles.sends) | set(roles.odd_sends)
        if function.name in _PLUMBING or function.name in plain:
            return False
        if function.pure and not is_declared(
            self.code, owner, function, partial(has_mailbox, self.code)
        ):
            return False
        is_by_hand = self._is_by_hand(owner, function)
        return not (is_by_hand or only_forwards(self.code, owner, function))

    def _is_by_hand(self, owner: CppClass, function: CppFunction) -> bool:
        """Whether a function that people added is none of the model, whatever calls it."""
        if self._served(owner, function) is not None or not has_mailbox(self.code, owner):
            return False
        return only_logs(self.code, owner, function) or stands_in(self.code, owner, function)

    def _served(self, owner: CppClass, function: CppFunction) -> str | None:
        """The server whose messages a function serves, here or in a class above."""
        for above in self.code.lineage(owner.name):
            server = self.roles[above.name].handlers.get(function.name)
            if server is not None:
                return server
            if not has_mailbox(self.code, above) and any(
                f.name == function.name for f in above.functions
            ):
                return plain_name(function, self.types)
        return None

    def _server(self, owner: CppClass, function: CppFunction, name: str) -> m.MessageServer:
        bodies, within = self._bodies(owner), f"{owner.name}.{name}"
        timers = self.timers.get(owner.name, ())
        timer = next((t for t in timers if t.callback == function.name), None)
        if timer is not None:
            parameters: tuple[m.Parameter, ...] = ()
            body: m.Block | None = bodies.ticking(timer, function, name, within)
        else:
            parameters = bodies.parameters(function)
            body = bodies.block(function, within)
        return m.MessageServer(
            name,
            parameters,
            body,
            function.pure and has_mailbox(self.code, owner),
            tuple(server_annotations(self.code, self.roles, owner, function, name)),
            function.cpp.span(function.node),
        )

    def _lambdas(self, owner: CppClass) -> Iterator[m.MessageServer]:
        """The servers whose handlers are lambdas: what the subscriptions hand over, and timers."""
        bodies = self._bodies(owner)
        for taken in self.roles[owner.name].taken:
            if taken.handler is None:
                fields = self.fields.get(taken.type)
                within = f"{owner.name}.{taken.server}"
                parameters, body = bodies.taken(taken, fields, within)
                span = taken.function.cpp.span(taken.call.node)
                shown = shown_of(self.code, taken)
                yield m.MessageServer(taken.server, parameters, body, False, shown, span)
        for timer, name in self._timed_servers(owner):
            if timer.lambda_ is not None and not (timer.one_shot and timer.posts is not None):
                body = bodies.ticking(timer, timer.function, name, f"{owner.name}.{name}")
                span = timer.function.cpp.span(timer.lambda_)
                yield m.MessageServer(name, (), body, False, (), span)

    def _timed_servers(self, owner: CppClass) -> Iterator[tuple[Timer, str]]:
        """The timers of a class with the servers that these send messages to."""
        handlers = self.roles[owner.name].handlers
        for index, timer in enumerate(self.timers.get(owner.name, ()), 1):
            once = timer.posts if timer.one_shot else None
            yield timer, once or handlers.get(timer.callback, f"timer{index}")

    def _method(self, owner: CppClass, function: CppFunction) -> m.Method:
        bodies, name = self._bodies(owner), plain_name(function, self.types)
        list_hiding(self.code, owner, function, self.findings)
        result = declared_type(self.code, function.result) if function.result is not None else None
        return m.Method(
            result or m.Type("void"),
            name,
            bodies.parameters(function),
            bodies.block(function, f"{owner.name}.{name}"),
            function.pure,
            annotations_in(function.markers, owner),
            function.cpp.span(function.node),
        )

    def _constructors(self, owner: CppClass) -> Iterator[m.Constructor]:
        """Those of the model, with what happens before and after them."""
        bodies, own = self._bodies(owner), self.roles[owner.name].own
        given = bodies.given(initial_values(self.code, owner, own), owner.name)
        at_start = (p for p in self._timed_servers(owner) if p[0].at_start)
        started = bodies.started(at_start, owner.name)
        name, found = class_name(owner.name), 0
        for function in self.code.functions_of(owner):
            if function.name != "construct":
                continue
            found += 1
            body = bodies.block(function, owner.name)
            if body is not None:
                body = replace(body, statements=(*given, *body.statements, *started))
            yield m.Constructor(
                name,
                bodies.parameters(function),
                body,
                annotations_in(function.markers, owner),
                function.cpp.span(function.node),
            )
        if not found and (given or started):
            yield m.Constructor(name, (), m.Block((*given, *started)))

    def _bodies(self, owner: CppClass) -> GeneratedBodies:
        by_hand = partial(as_by_hand, self.code, owner, self.shown)
        sensors = frozenset(f"{owner.name}.{name}" for name in self.roles[owner.name].sensors)
        return GeneratedBodies(self.code, self.scope(owner), self.findings, by_hand, sensors)

    # --- names ----------------------------------------------------------------------------------

    def scope(self, owner: CppClass) -> Scope:
        """What the bodies of a class can name."""
        if owner.name not in self._scopes:
            self._scopes[owner.name] = self._scope(owner)
        return self._scopes[owner.name]

    def _scope(self, owner: CppClass) -> Scope:
        members: dict[str, Member] = {}
        functions: dict[str, Function] = {}
        callable_: set[str] = set()
        for above in reversed(self.code.lineage(owner.name)):
            roles = self.roles[above.name]
            given = self.code, roles, self.served, self.messages
            members |= {f.name: meaning_of(f, *given) for f in above.fields}
            for function in self.code.functions_of(above):
                served = self._served(above, function)
                if function.name in roles.sends:
                    functions[function.name] = roles.sends[function.name]
                elif served is not None:
                    functions[function.name] = Called(served, server=True)
                elif self._is_of_model(above, function):
                    functions[function.name] = called(self.code, function, self.types)
                    callable_.add(function.name)
                else:
                    only = only_logs(self.code, above, function)
                    only = only and self._is_by_hand(above, function)
                    functions.setdefault(function.name, Ignored() if only else Around())
            callable_ |= roles.constants | set(roles.sends)
        for function in functions_beside(self.code, owner):
            functions[function.name] = called(self.code, function, self.types)
            callable_.add(function.name)
        return Scope(
            members,
            functions,
            {c.name: class_name(c.name) for c in self.code.lineage(owner.name)[1:]},
            self.types,
            frozenset(callable_),
            timers={t.call.node.id: server_of_timer(t, n) for t, n in self._timed_servers(owner)},
            posts=dict(posts_in_bodies(self.code, owner, self.roles, self.served)),
            enumerators=enumerators(self.code),
            enums=frozenset(e.enum for all_ in self.code.enumerators.values() for e in all_)
            - narrow_enums(self.code).keys(),
            aliases=aliases(self.code),
            messages=self.messages,
            unit=self.unit,
            form=self.form,
        )
