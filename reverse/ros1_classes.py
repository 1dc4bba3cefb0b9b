"""Classes of generated code as reactive classes and interfaces."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import field, replace

from rebsync import model as m
from rebsync.names import carry, uncarry
from rebsync.records import dataclass
from rebsync.reserved import RESERVED, RUNTIME_MEMBERS
from rebsync.reverse.cpp_calls import call_of
from rebsync.reverse.cpp_index import Code, CppClass, CppField, CppFunction
from rebsync.reverse.cpp_statements import CppStatements
from rebsync.reverse.cpp_tree import named, text_of
from rebsync.reverse.cpp_types import class_name, type_of
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.ros1_plumbing import check_plumbing
from rebsync.reverse.ros1_roles import Roles, add_sends, roles_of
from rebsync.reverse.scope import Called, Function, Member, Runtime, Scope, Variable
from rebsync.reverse.written import annotation

_RUNTIME: dict[str, Runtime] = {
    "Mailbox": Runtime("mailbox"),
    "Drive": Runtime("drive"),
    "Sensor": Runtime("sensor"),
}
_ROS = frozenset({"Publisher", "Publishers", "Subscriber"})
_PLUMBING = frozenset({"mailbox", "publishState"})


@dataclass(slots=True)
class Classes:
    """Reads the classes of some code that have a mailbox, and the interfaces of these."""

    code: Code
    findings: Findings
    types: frozenset[str] = frozenset()
    roles: dict[str, Roles] = field(default_factory=dict)
    _scopes: dict[str, Scope] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for owner in self.code.classes.values():
            self.roles[owner.name] = roles_of(self.code, owner)
        for owner in self.code.classes.values():
            add_sends(self.code, owner, self.roles)
        messages = {n for roles in self.roles.values() for n in roles.messages}
        messages |= {p.message for roles in self.roles.values() for p in roles.publishers.values()}
        states = {s for c in self.code.classes.values() for s in _state_types(self.code, c)}
        self.types = frozenset(messages | states | set(self.code.classes))

    def read(self, wanted: set[str] | None = None) -> tuple[m.ReactiveClass | m.Interface, ...]:
        """All of them, or those that are wanted, in the order of the code."""
        return tuple(
            self._reactive(c) if self._has_mailbox(c) else self._interface(c)
            for c in self.code.classes.values()
            if (self._has_mailbox(c) or _is_interface(c)) and (wanted is None or c.name in wanted)
        )

    def _has_mailbox(self, owner: CppClass) -> bool:
        return any(
            text_of(f.type) == "Mailbox" for c in self.code.lineage(owner.name) for f in c.fields
        )

    # --- one class ------------------------------------------------------------------------------

    def _interface(self, owner: CppClass) -> m.Interface:
        servers = tuple(
            self._server(owner, f, self._plain(f)) for f in self.code.functions_of(owner) if f.pure
        )
        extends = tuple(class_name(b) for b in owner.bases)
        span = owner.cpp.span(owner.node)
        return m.Interface(
            class_name(owner.name), servers, extends, _annotations(owner.markers, owner), span
        )

    def _reactive(self, owner: CppClass) -> m.ReactiveClass:
        check_plumbing(self.code, owner, self.roles, self.findings)
        functions = [f for f in self.code.functions_of(owner) if self._is_of_model(owner, f)]
        constructors = [f for f in self.code.functions_of(owner) if f.name == "construct"]
        methods = [f for f in functions if self._served(owner, f) is None]
        known, state = self._variables(owner)
        members: list[m.ClassMember] = [m.KnownRebecs(tuple(known))] if known else []
        members += [m.StateVars(tuple(state))] if state else []
        members += [self._constructor(owner, f) for f in constructors]
        members += [
            self._server(owner, f, name)
            for f in functions
            if (name := self._served(owner, f)) is not None
        ]
        members += [self._method(owner, f) for f in methods]
        extends = [b for b in owner.bases if self._is_reactive(b)]
        return m.ReactiveClass(
            class_name(owner.name),
            self.roles[owner.name].queue_length or 1,
            tuple(members),
            self._is_abstract(owner),
            class_name(extends[0]) if extends else None,
            tuple(class_name(b) for b in owner.bases if b not in extends),
            tuple(self._class_annotations(owner)),
            owner.cpp.span(owner.node),
        )

    def _class_annotations(self, owner: CppClass) -> Iterator[m.Annotation]:
        """Those of the markers; without markers, those that the set-up shows."""
        if any(x.startswith("reactiveclass ") for x in owner.markers):
            yield from _annotations(owner.markers, owner)
            return
        if any(text_of(f.type) == "Drive" for f in owner.fields):
            yield m.Annotation("Robot")
        if self.roles[owner.name].on_bridge:
            yield m.Annotation("Controller")

    def _server_annotations(
        self, owner: CppClass, function: CppFunction, name: str
    ) -> Iterator[m.Annotation]:
        """Those of the markers; without markers, those that the set-up shows."""
        if any(x.startswith("msgsrv ") for x in function.markers):
            yield from _annotations(function.markers, owner)
            return
        if name in self.roles[owner.name].sensors:
            yield m.Annotation("Sensor")
        overload = name, len(function.parameters)
        for above in self.code.lineage(owner.name):
            shown = self.roles[above.name].annotations.get(overload)
            if shown is not None:
                same = [f for f in above.functions if f.name == function.name]
                same = [f for f in same if len(f.parameters) == overload[1]]
                index = next((i for i, f in enumerate(same) if f.types == function.types), 0)
                yield from shown[min(index, len(shown) - 1)]
                return

    def _is_reactive(self, name: str) -> bool:
        owner = self.code.classes.get(name)
        return owner is not None and self._has_mailbox(owner)

    def _is_abstract(self, owner: CppClass) -> bool:
        """Whether no node is of this class: then it does not say what its state is."""
        return not any(f.name == "publishState" and not f.pure for f in owner.functions)

    # --- variables ------------------------------------------------------------------------------

    def _variables(self, owner: CppClass) -> tuple[list[m.Declaration], list[m.Declaration]]:
        roles = self.roles[owner.name]
        known: list[m.Declaration] = []
        state: list[m.Declaration] = []
        for member in owner.fields:
            if self._runtime(member) or member.name in roles.globals:
                continue
            type_ = type_of(member.type)
            if type_ is None:
                if text_of(member.type).rpartition("::")[2] not in _ROS:
                    why = f'the model has no type "{text_of(member.type)}"'
                    unread = Unread(member.cpp.span(member.node), why)
                    self.findings.unreadable(member.cpp.source, unread, owner.name)
                continue
            span = member.cpp.span(member.node)
            declarator = m.Declarator(self.variable(owner, member), None, span)
            declaration = m.Declaration(type_, (declarator,), span=span)
            (known if member.name in roles.known else state).append(declaration)
        return known, state

    def variable(self, owner: CppClass, member: CppField) -> str:
        """The model's name of a member variable, from its marker unless it was renamed."""
        known = self.roles[owner.name].known.get(member.name)
        if known is not None:
            return known
        for marker in member.markers:
            kind, path, *_ = [*marker.split(), "", ""]
            name = path.rpartition(".")[2]
            carried = re.escape(carry(name, RUNTIME_MEMBERS))
            if kind in ("statevar", "env") and re.fullmatch(rf"{carried}_(_\d+)?", member.name):
                return name
        return uncarry(member.name.removesuffix("_"), RUNTIME_MEMBERS)

    def _runtime(self, member: CppField) -> Runtime | None:
        text = text_of(member.type)
        return _RUNTIME.get(text.partition("<")[0])

    # --- functions ------------------------------------------------------------------------------

    def _is_of_model(self, owner: CppClass, function: CppFunction) -> bool:
        roles = self.roles[owner.name]
        if function.name in (owner.name, f"~{owner.name}", "construct"):
            return False
        if function.name in _PLUMBING or function.name in roles.shims | set(roles.sends):
            return False
        if function.pure and not self._declares(owner, function):
            return False
        return not self._only_forwards(owner, function)

    def _declares(self, owner: CppClass, function: CppFunction) -> bool:
        """Whether the model declares an abstract function here, not only an interface above."""
        names = {f"msgsrv {owner.name}.", f"method {owner.name}."}
        if any(marker.startswith(n) for n in names for marker in function.markers):
            return not any(
                f.name == function.name and f.types == function.types
                for c in self.code.lineage(owner.name)[1:]
                if not self._has_mailbox(c)
                for f in c.functions
            )
        return True

    def _only_forwards(self, owner: CppClass, function: CppFunction) -> bool:
        """Whether it only makes an inherited function that of an interface as well."""
        statements = named(function.body) if function.body is not None else []
        if not function.overrides or len(statements) != 1:
            return False
        inner = named(statements[0])
        call = call_of(inner[0]) if inner else None
        if call is None or any(x.startswith(("msgsrv ", "method ")) for x in function.markers):
            return False
        passed = [text_of(a) for a in call.arguments]
        inherited = {f"{b}::{function.name}" for b in self._above(owner)}
        return call.name in inherited and passed == [p.name for p in function.parameters]

    def _above(self, owner: CppClass) -> set[str]:
        return {c.name for c in self.code.lineage(owner.name)[1:]}

    def _served(self, owner: CppClass, function: CppFunction) -> str | None:
        """The server whose messages a function serves, here or in a class above."""
        for above in self.code.lineage(owner.name):
            server = self.roles[above.name].handlers.get(function.name)
            if server is not None:
                return server
            if not self._has_mailbox(above) and any(
                f.name == function.name for f in above.functions
            ):
                return self._plain(function)
        return None

    def _plain(self, function: CppFunction) -> str:
        """The model's name of a function, from its marker unless it was renamed."""
        for marker in function.markers:
            kind, path, *_ = [*marker.split(), "", ""]
            name = path.rpartition(".")[2]
            if kind not in ("msgsrv", "method") or not path:
                continue
            apart = function.name.startswith(f"{name}_")  # from overloads that C++ cannot tell
            if apart or carry(name, RESERVED | self.types) == function.name:
                return name
        return uncarry(function.name, RESERVED | self.types)

    def _server(self, owner: CppClass, function: CppFunction, name: str) -> m.MessageServer:
        scope = self.scope(owner)
        return m.MessageServer(
            name,
            self._parameters(function, scope),
            self._body(function, scope, f"{owner.name}.{name}"),
            function.pure and self._has_mailbox(owner),
            tuple(self._server_annotations(owner, function, name)),
            function.cpp.span(function.node),
        )

    def _method(self, owner: CppClass, function: CppFunction) -> m.Method:
        scope, name = self.scope(owner), self._plain(function)
        result = type_of(function.result) if function.result is not None else None
        return m.Method(
            result or m.Type("void"),
            name,
            self._parameters(function, scope),
            self._body(function, scope, f"{owner.name}.{name}"),
            function.pure,
            _annotations(function.markers, owner),
            function.cpp.span(function.node),
        )

    def _constructor(self, owner: CppClass, function: CppFunction) -> m.Constructor:
        scope = self.scope(owner)
        return m.Constructor(
            class_name(owner.name),
            self._parameters(function, scope),
            self._body(function, scope, owner.name),
            _annotations(function.markers, owner),
            function.cpp.span(function.node),
        )

    def _parameters(self, function: CppFunction, scope: Scope) -> tuple[m.Parameter, ...]:
        found = []
        for parameter in function.parameters:
            span = function.cpp.span(parameter.node)
            type_ = type_of(parameter.type)
            if type_ is None:
                why = f'the model has no type "{text_of(parameter.type)}"'
                self.findings.unreadable(function.cpp.source, Unread(span, why), function.name)
            found.append(m.Parameter(type_ or m.Type("int"), scope.local(parameter.name), span))
        return tuple(found)

    def _body(self, function: CppFunction, scope: Scope, within: str) -> m.Block | None:
        if function.body is None:
            return None
        constants = self.code.constants_for(function.cpp)
        scope = replace(scope, constants=constants)
        inside = scope.declare(*(p.name for p in function.parameters))
        reader = CppStatements(function.cpp, inside, self.findings, within)
        return reader.block(function.body)

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
            for member in above.fields:
                runtime = self._runtime(member)
                members[member.name] = runtime or Variable(self.variable(above, member))
            for function in self.code.functions_of(above):
                served = self._served(above, function)
                if function.name in roles.sends:
                    functions[function.name] = roles.sends[function.name]
                elif served is not None:
                    functions[function.name] = Called(served, server=True)
                elif self._is_of_model(above, function):
                    functions[function.name] = Called(self._plain(function))
                    callable_.add(function.name)
            callable_ |= roles.constants | set(roles.sends)
        bases = {b: class_name(b) for b in self._above(owner)}
        return Scope(members, functions, bases, self.types, frozenset(callable_))


def _is_interface(owner: CppClass) -> bool:
    """Whether a class only says what its heirs can do."""
    destructor = f"~{owner.name}"
    names = {f.name for f in owner.functions}
    others = (f for f in owner.functions if f.name != destructor)
    return not owner.fields and destructor in names and all(f.pure for f in others)


def _annotations(markers: tuple[str, ...], owner: CppClass) -> tuple[m.Annotation, ...]:
    span = owner.cpp.span(owner.node)
    return tuple(a for text in markers if (a := annotation(text, span)) is not None)


def _state_types(code: Code, owner: CppClass) -> Iterator[str]:
    """The types of the messages that tell the state of a class's nodes."""
    for function in code.functions_of(owner):
        if function.name == "publishState" and function.body is not None:
            for statement in named(function.body)[:1]:
                type_ = statement.child_by_field_name("type")
                if type_ is not None:
                    yield text_of(type_)
