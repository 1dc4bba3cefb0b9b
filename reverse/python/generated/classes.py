"""Classes of generated Python as reactive classes and interfaces."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field as with_default
from dataclasses import replace
from functools import cached_property, partial

from tree_sitter import Node

from rebsync import model as m
from rebsync.intervals import Interval
from rebsync.names import carry, original, uncarry
from rebsync.records import dataclass
from rebsync.reserved import NO_PYTHON_CLASSES, OFFERS, RUNTIME_TOPICS
from rebsync.reverse.bodies.overloads import Served
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.findings import Findings
from rebsync.reverse.generated.annotations import of_class, of_server
from rebsync.reverse.generated.messages import NO_MESSAGES, OwnMessages
from rebsync.reverse.generated.own_parameters import Stored, with_own
from rebsync.reverse.generated.receivers import known_rebecs
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.generated import first_values
from rebsync.reverse.python.generated.bodies import ModelBodies
from rebsync.reverse.python.generated.dead_methods import unless_dead
from rebsync.reverse.python.generated.function_names import plain_name
from rebsync.reverse.python.generated.marks import is_abstract, is_constructor, is_marked
from rebsync.reverse.python.generated.module_top import ModuleTop
from rebsync.reverse.python.generated.named_constants import CodeConstants
from rebsync.reverse.python.generated.overloads import families
from rebsync.reverse.python.generated.plumbing import Plumbing
from rebsync.reverse.python.generated.posts import learn_servers
from rebsync.reverse.python.generated.py_types import (
    annotations_above,
    class_name,
    markers_above,
    messages_of,
)
from rebsync.reverse.python.generated.queues import length_of
from rebsync.reverse.python.generated.roles import (
    EnvUse,
    PyRoles,
    PySends,
    is_people_own,
    roles_of,
)
from rebsync.reverse.python.generated.slicing.numbers import numbers_for_people
from rebsync.reverse.python.generated.slicing.silent import silent_in
from rebsync.reverse.python.generated.value_types import typed
from rebsync.reverse.python.values.class_creation import list_creation
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.syntax.py_index import PyCode, Scope, classes_in
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import named, text_of


@dataclass(eq=False)
class ModelClasses:
    """Reads the classes of some code that have a mailbox, and the interfaces of these.

    `messages` are the package's message types, by their names alone, `served` what classes serve,
    those in another language among them.
    `constants` are the integers that some names of the model always stand for.
    """

    code: PyCode
    findings: Findings
    messages: OwnMessages = NO_MESSAGES
    served: Served = with_default(default_factory=Served)
    constants: Mapping[str, Interval] = with_default(default_factory=dict)
    roles: dict[int, PyRoles] = with_default(default_factory=dict)

    def __post_init__(self) -> None:
        self._values = PyValues(self.code)
        told = self.messages.constants
        self._named = CodeConstants(self.code, values=self._values, messages=told)
        self._form = PyForm(
            self.code,
            MessageTypes({}, ""),
            without_runtime=True,
            typed=lambda program: typed(program, self.roles.values()),
        )
        self._owners = [c for c in classes_in(self.code) if not is_runtime_file(c.py.source)]
        self._lines: dict[int, list[Scope]] = {}
        if not any("Mailbox(" in s.py.source.text for s in self.code.modules.values()):
            self._owners = [o for o in self._owners if is_marked(o)]
        for owner in self._owners:
            self.roles[id(owner)] = roles_of(self.code, owner)
        reached = {id(c) for o in self._owners if self._has_mailbox(o) for c in self.line(o)}
        self._owners = [
            o
            for o in self._owners
            if id(o) in reached or is_marked(o) or (reached and self._is_only_declared(o))
        ]
        for owner in self._owners:
            roles, line = self._of(owner), self.line(owner)
            if not self._is_alone(owner):
                roles.own.clear()
            elif own := roles.own.keys() | numbers_for_people(roles):
                all_roles = [*map(self._of, line)]
                roles.leave_out(silent_in(self.code, self._form, line, all_roles, own).texts & own)
        for owner in self._owners:
            learn_servers(self.line(owner), self._of)
        own = {o.name for o in self._owners}
        self._types = frozenset({*self.messages.fields, *messages_of(self._owners), *own})

    @cached_property
    def _bodies(self) -> ModelBodies:
        in_cpp = (carry(name, NO_PYTHON_CLASSES) for name in self.served.classes)
        return ModelBodies(
            self.code,
            self._form,
            self.findings,
            self.line,
            self._of,
            self._served,
            self._types.union(in_cpp),
            self.served,
            self.messages.fields,
            self.constants,
            self._named,
        )

    @cached_property
    def _signed(self) -> OwnMessages:
        """The message types, of which shims may tell as well that they say who sends them."""
        told = (type_ for roles in self.roles.values() for type_ in roles.signed)
        return replace(self.messages, signed=self.messages.signed.union(told))

    def families(self) -> dict[str, dict[str, str]]:
        """By class the servers, those above included, by the types of their messages."""
        return families((o, map(self._of, self.line(o))) for o in self._owners)

    def line(self, owner: Scope) -> list[Scope]:
        """A class and those above it, nearest first."""
        if id(owner) not in self._lines:
            found = lineage(self._values, owner)
            self._lines[id(owner)] = [c for c in found if isinstance(c, Scope)]
        return self._lines[id(owner)]

    @property
    def owners(self) -> list[Scope]:
        """The classes of Python that are of the model."""
        return self._owners

    def read(self, path: str | None = None) -> tuple[m.ReactiveClass | m.Interface, ...]:
        """All of them in the order of the code, or those of a file."""
        wanted = [o for o in self._owners if path is None or o.py.source.path == path]
        for module in {id(o.module): o.module for o in wanted}.values():
            owners = [o for o in self._owners if o.module is module]
            names = [self._bodies.names(o) for o in owners]
            ModuleTop(module, self._named, names, owners).check(self.findings)
        for owner in wanted:
            functions = self._of(owner).functions.values()
            list_creation(self._values, owner, functions, self.findings)
        return tuple(
            self._reactive(o) if self._has_mailbox(o) else self._interface(o)
            for o in wanted
            if not self._is_helping(o)
        )

    def arguments(self) -> dict[str, list[str]]:
        """The parameters that the constructors of classes read for their arguments, in order."""
        return {class_name(o.name): list(self._of(o).arguments.values()) for o in self._owners}

    def own(self) -> dict[str, list[Stored]]:
        """By class the state variables that parameters of the node are stored in."""
        return {class_name(o.name): found for o in self._owners if (found := self._own(o))}

    def _own(self, owner: Scope) -> list[Stored]:
        roles = self._of(owner)
        kept = ((roles.state[name], own) for name, (own, _) in roles.own.items())
        return [Stored(n, type_, own, owner.py.span(node)) for (n, type_, node), own in kept]

    def _is_alone(self, owner: Scope) -> bool:
        """Whether no class of the model is above or below one: constructors go apart there."""
        related = (c for o in self._owners if owner in (line := self.line(o)) for c in line)
        own = (c for c in related if c is not owner and not is_runtime_file(c.py.source))
        return not any(map(self._has_mailbox, own))

    def env(self) -> Iterator[EnvUse]:
        """The constants that classes read."""
        return (e for o in self._owners for e in self._of(o).env.values())

    def _of(self, owner: Scope) -> PyRoles:
        if id(owner) not in self.roles:
            self.roles[id(owner)] = roles_of(self.code, owner)
        return self.roles[id(owner)]

    def _is_only_declared(self, owner: Scope) -> bool:
        """Whether a class only says what its heirs can do, as an interface that nobody has."""
        bases = owner.node.child_by_field_name("superclasses")
        names = {text_of(b) for b in named(bases)} if bases is not None else set()
        functions = self._of(owner).functions.values()
        is_plain = names <= {"ABC"} and not owner.attributes and (functions or names)
        return bool(is_plain) and all(map(is_abstract, functions))

    def _has_mailbox(self, owner: Scope) -> bool:
        return any(self._of(c).has_mailbox for c in self.line(owner))

    # --- classes --------------------------------------------------------------------------------

    def _interface(self, owner: Scope) -> m.Interface:
        functions = self._of(owner).functions.values()
        servers = tuple(self._server(owner, f, plain_name(f)) for f in functions)
        self._bodies.list_beyond(owner, None)
        line = self.line(owner)[1:]
        extends = tuple(class_name(c.name) for c in line if self._is_base(owner, c))
        span = owner.py.span(owner.node)
        return m.Interface(
            class_name(owner.name), servers, extends, annotations_above(owner.py, owner.node), span
        )

    def _is_lost(self, sends: PySends) -> bool:
        """Whether a message goes to a server that no subscription takes messages to."""
        message, _, key = sends.server.partition(" ")
        posted = {server for roles in self.roles.values() for server in roles.posted}
        return message not in self.served.servers and uncarry(key, RUNTIME_TOPICS) in posted

    def _is_base(self, owner: Scope, above: Scope) -> bool:
        """Whether a class is named among the bases of another."""
        bases = owner.node.child_by_field_name("superclasses")
        return bases is not None and above.name in map(text_of, named(bases))

    def _reactive(self, owner: Scope) -> m.ReactiveClass:
        roles = self._of(owner)
        names, lineage = self._bodies.names(owner), self.line(owner)[1:]
        before = len(self.findings.all)
        Plumbing(
            *(roles, self._signed, self.findings, self._named, names.silent, lineage),
            *(names.posts, self._is_lost, self.constants),
        ).check()
        members: list[m.ClassMember] = []
        state = [self._variable(owner, *v) for v in roles.state.values()]
        known = self._known(owner, state)
        members += [m.KnownRebecs(tuple(known))] if known else []
        members += [m.StateVars(tuple(state))] if state else []
        constructors = tuple(self._constructors(owner))
        constructors = tuple(with_own(constructors, self._own(owner), class_name(owner.name)))
        members += constructors
        rest = [f for f in self._functions(owner) if self._is_of_model(owner, f)]
        served = {f.name: self._served(owner, f) for f in rest}
        members += [self._server(owner, f, s) for f in rest if (s := served[f.name]) is not None]
        members += [x for f in rest if served[f.name] is None and (x := self._live(owner, f))]
        members += [self._method(owner, f) for f in self._bodies.helpers(owner)]
        is_whole = self._is_alone(owner) and len(self.findings.all) == before
        self._bodies.list_beyond(owner, constructors if is_whole else None)
        own = (c for c in self.line(owner)[1:] if not is_runtime_file(c.py.source))
        bases = [c for c in own if not self._is_helping(c) and self._is_base(owner, c)]
        extends = [class_name(c.name) for c in bases if self._has_mailbox(c)]
        return m.ReactiveClass(
            class_name(owner.name),
            length_of(self._named, owner, roles.queues, roles.queue, self.findings),
            tuple(members),
            not roles.is_executable,
            extends[0] if extends else None,
            tuple(class_name(c.name) for c in bases if not self._has_mailbox(c)),
            tuple(self._shown(owner)),
            owner.py.span(owner.node),
        )

    def _functions(self, owner: Scope) -> Iterator[Scope]:
        """The functions of a class, and those that it has from classes that are only helpers."""
        own = self._of(owner).functions
        yield from own.values()
        line = self.line(owner)[1:]
        nearest = next((i for i, c in enumerate(line) if self._has_mailbox(c)), len(line))
        for above in filter(self._is_helping, line[:nearest]):
            taken = own.keys() | self._of(above).ticking
            yield from (f for n, f in self._of(above).functions.items() if n not in taken)

    def _is_helping(self, owner: Scope) -> bool:
        """Whether a class has nothing but functions with bodies, for its heirs."""
        functions = self._of(owner).functions
        is_plain = not (owner.attributes or is_marked(owner) or self._has_mailbox(owner))
        return bool(functions) and is_plain and not any(map(is_abstract, functions.values()))

    def _shown(self, owner: Scope) -> Iterator[m.Annotation]:
        roles, markers = self._of(owner), markers_above(owner.py, owner.node)
        is_marked = any(x.startswith("reactiveclass ") for x in markers)
        marked = annotations_above(owner.py, owner.node) if is_marked else None
        return of_class(marked, has_drive=roles.has_drive, on_bridge=roles.on_bridge)

    def _known(self, owner: Scope, state: Sequence[m.Declaration]) -> list[m.Declaration]:
        """The known rebecs of a class with some state variables."""
        roles = self._of(owner)
        members = [self._variable(owner, *v) for v in roles.known.values()]
        spans = {name: owner.py.span(node) for name, node in roles.connected.items()}
        above = (self._of(c).receivers for c in self.line(owner)[1:])
        return known_rebecs(members, state, roles.receivers, spans, above)

    def _variable(self, owner: Scope, name: str, type_: m.Type, statement: Node) -> m.Declaration:
        span = owner.py.span(statement)
        declarator = m.Declarator(name, None, span)
        return m.Declaration(type_, (declarator,), annotations_above(owner.py, statement), span)

    # --- functions ------------------------------------------------------------------------------

    def _is_of_model(self, owner: Scope, function: Scope) -> bool:
        name = function.name
        if is_abstract(function) and self._is_of_interface(owner, name):
            return False
        return not (self._of(owner).is_plumbing(name) or is_constructor(name))

    def _is_of_interface(self, owner: Scope, name: str) -> bool:
        """Whether an interface above declares a function."""
        above = (c for c in self.line(owner)[1:] if not self._has_mailbox(c))
        return any(name in self._of(c).functions for c in above)

    def _served(self, owner: Scope, function: Scope) -> str | None:
        """The server whose messages a function serves, here or in a class above."""
        for above in self.line(owner):
            roles = self._of(above)
            if function.name in roles.handlers:
                return roles.handlers[function.name]
            is_declared = function.name in roles.functions and not self._is_helping(above)
            if is_declared and not self._has_mailbox(above):
                return plain_name(function)
        return None

    def _server(self, owner: Scope, function: Scope, name: str) -> m.MessageServer:
        within = f"{class_name(owner.name)}.{name}"
        return m.MessageServer(
            name,
            self._bodies.parameters(owner, function, within),
            self._bodies.body(owner, function, within),
            is_abstract(function) and self._has_mailbox(owner),
            tuple(self._server_annotations(owner, function, name)),
            function.py.span(function.node),
        )

    def _server_annotations(
        self, owner: Scope, function: Scope, name: str
    ) -> Iterator[m.Annotation]:
        markers = markers_above(function.py, function.node)
        is_marked = any(x.startswith("msgsrv ") for x in markers)
        return of_server(
            annotations_above(function.py, function.node) if is_marked else None,
            self._set_up(owner, function),
            is_sensor=any(name in (s, original(s)) for s in self._of(owner).sensors),
        )

    def _set_up(self, owner: Scope, function: Scope) -> tuple[m.Annotation, ...] | None:
        """The annotations that the set-up of a server shows, here or in a class above."""
        for above in self.line(owner):
            shown = self._of(above).shown.get(function.name)
            if shown is not None:
                # A service or action is said where it is offered, and nowhere below.
                return tuple(a for a in shown if above is owner or a.name not in OFFERS)
        return None

    def _live(self, owner: Scope, function: Scope) -> m.Method | None:
        """A method; None for one that no model can have, and that nothing runs."""
        read, noted = partial(self._method, owner), self._bodies.noted.setdefault(id(owner), [])
        if not is_people_own(self._of(owner), function.name):
            return read(function)
        return unless_dead(self.code, function, self.findings, noted, read)

    def _method(self, owner: Scope, function: Scope) -> m.Method:
        name = plain_name(function)
        within = f"{class_name(owner.name)}.{name}"
        return m.Method(
            self._bodies.result(owner, function, within),
            name,
            self._bodies.parameters(owner, function, within),
            self._bodies.body(owner, function, within),
            is_abstract(function),
            annotations_above(function.py, function.node),
            function.py.span(function.node),
        )

    def _constructors(self, owner: Scope) -> Iterator[m.Constructor]:
        name = class_name(owner.name)
        roles = self._of(owner)
        found = [f for f in roles.functions.values() if is_constructor(f.name)]
        first = self._first(owner, name)
        for function in found:
            body = self._bodies.body(owner, function, name)
            if first and body is not None:
                body = replace(body, statements=(*first, *body.statements))
            yield m.Constructor(
                name,
                self._bodies.parameters(owner, function, name),
                body,
                annotations_above(function.py, function.node),
                function.py.span(function.node),
            )
        if first and not found:
            yield m.Constructor(name, (), m.Block(first), (), owner.py.span(owner.node))

    def _first(self, owner: Scope, within: str) -> tuple[m.Statement, ...]:
        """What variables hold before the constructor of the model runs."""
        roles = self._of(owner)
        if not roles.initial:
            return ()
        reader = self._bodies.reader(owner, roles.initial[0][2], within).expressions
        return tuple(first_values.stores(roles.initial, roles.state, reader, self.findings, within))
