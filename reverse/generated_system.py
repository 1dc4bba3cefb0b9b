"""What generated code and its launch file say together: constants, rebecs, the unit of time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

from rebsync import model as m
from rebsync.literals import initial_of, literal_of
from rebsync.names import TAKEN_NODES, graph_name, uncarry
from rebsync.package import Value
from rebsync.records import dataclass
from rebsync.reserved import RESERVED_GLOBALS
from rebsync.reverse.bodies.cpp_messages import zero_of
from rebsync.reverse.bodies.types.cpp_types import class_name, type_of
from rebsync.reverse.bodies.written import annotation
from rebsync.reverse.findings import Unread
from rebsync.reverse.generated.cpp_classes import Classes
from rebsync.reverse.generated.cpp_names import stored_in, variable_name
from rebsync.reverse.generated.env_values import (
    as_type,
    constant,
    is_taken,
    marked_type,
    plain_value,
    shaped,
    type_of_value,
)
from rebsync.reverse.generated.own_parameters import OwnParameter, Stored, given_to, list_refused
from rebsync.reverse.generated.parameters import objects_in
from rebsync.reverse.generated.ros2_words import made_in
from rebsync.reverse.launch.launch_files_ros2 import speaks_ros_2
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.launch.misdirected import is_reached, list_misdirected, redirected
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.nodes.node_programs import Program
from rebsync.reverse.syntax.cpp_calls import calls_in, string_of
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.source import NOWHERE

if TYPE_CHECKING:
    from rebsync.reverse.python.recovery import PythonPart

_TIME_UNIT = "/mailbox/time_unit"
_CONSTANTS = "env/"
_HINT = "give it a value of the type that the code asks for"
_GIVE = "give it in the launch file"


def unit_of_time(launch: Launch | None) -> Fraction:
    """The seconds that a unit of time takes in generated nodes."""
    for parameter in launch.parameters if launch is not None else ():
        value = parameter.value
        if parameter.name != _TIME_UNIT or not isinstance(value, (int, float)):
            continue
        if 0 < value < math.inf:
            return Fraction(repr(value))
    return Fraction(1)


@dataclass(frozen=True, slots=True)
class GeneratedSystem:
    """What code and launch file say together: constants and rebecs."""

    code: Code
    classes: Classes
    read: tuple[m.ReactiveClass | m.Interface, ...]
    launch: Launch | None
    programs: tuple[Program, ...]
    python: PythonPart | None = None

    @property
    def common(self) -> tuple[Parameter, ...]:
        """The parameters that are under no node, and constants that each rebec is given alike."""
        if self.launch is None:
            return ()
        given = [n.parameters for n in self.launch.nodes if self._started(n) is not None]
        first = {p.name: p for p in (given[0] if given else ()) if p.name.startswith(_CONSTANTS)}
        alike = [
            replace(p, name=f"/{name}")
            for name, p in first.items()
            if all(_is_given(parameters, p) for parameters in given)
        ]
        return (*self.launch.parameters, *alike)

    # --- constants ------------------------------------------------------------------------------

    def heads(self) -> Iterator[m.Env]:
        """The constants of the model: all global parameters but those of the run-time part."""
        used = dict(self._used())
        every = (s.parameter for o in self.read for s in self._stored(o.name))
        told = (p for o in self.read for p in self._told(o.name))
        own = {f"/{p.key}" for p in (*every, *told) if p.for_all}
        common = (p for p in self.common if p.name not in own)
        given = {p.name.lstrip("/").removeprefix("env/"): p for p in common}
        for key in [*given, *(k for k in used if k not in given)]:
            first = key.partition("/")[0]
            if first in RESERVED_GLOBALS or "/" in key:
                continue
            type_, name, default = used.get(key, (None, "", None))
            value = plain_value(given[key]) if key in given else default
            if value is None:
                continue
            if type_ is not None and key in given and not self._is_taken(given[key], type_):
                self._list_other_kind(given[key], key, "env")
                value = default
            if value is None:
                continue
            if type_ is None:
                type_, name = marked_type(given[key]) or (type_of_value(value), "")
            initial = initial_of(as_type(shaped(value, type_.dimensions), type_))
            span = given[key].source.within(given[key].span) if key in given else NOWHERE
            declarator = m.Declarator(name or uncarry(key, self._taken()), initial, span)
            yield m.Env(m.Declaration(type_, (declarator,), span=span), span)

    def _used(self) -> Iterator[tuple[str, tuple[m.Type, str, Value | None]]]:
        """The global parameters that classes read: type, name, and default."""
        names = {c.name for c in self.read}
        yield from self.python.used if self.python is not None else ()
        for owner in self.code.classes.values():
            roles = self.classes.roles[owner.name]
            for member in owner.fields:
                if member.name not in roles.globals or class_name(owner.name) not in names:
                    continue
                key, default = roles.globals[member.name]
                type_ = type_of(member.type)
                if type_ is not None:
                    name = variable_name(roles, member)
                    yield key, (type_, name, constant(default))

    def _taken(self) -> frozenset[str]:
        return RESERVED_GLOBALS | {n.name for n in self._nodes() if isinstance(n.name, str)}

    # --- rebecs ---------------------------------------------------------------------------------

    def main(self) -> m.Main | None:
        """The rebecs that the launch file starts; None without one."""
        if self.launch is None:
            return None
        return m.Main(tuple(r for n in self.launch.nodes if (r := self._rebec(n)) is not None))

    def _rebec(self, node: LaunchedNode) -> m.Rebec | None:
        started = self._started(node)
        if started is None or not isinstance(node.name, str):
            return None
        type_, keys = started
        declared = self._lineage(type_)
        if not declared:
            return None  # the class could not be read, which is told of it
        known = [
            d.name
            for c in reversed(declared)
            for section in c.members
            if isinstance(section, m.KnownRebecs)
            for declaration in section.declarations
            for d in declaration.declarators
        ]
        other = {k: to for k in known if (to := self._redirected(node, k, declared)) is not None}
        told = [k for k in known if k not in other]
        list_misdirected(node, told, self._nodes(), self.classes.findings, type_)
        self._list_unreached(node, type_)
        bindings = [self._bound(node, f"knownrebecs/{graph_name(k)}", other.get(k)) for k in known]
        constructors = [c for c in declared[0].members if isinstance(c, m.Constructor)]
        own = self._stored(type_)
        count = len(keys) + len(own)
        parameters = next((c.parameters for c in constructors if len(c.parameters) == count), ())
        arguments = [
            self._argument(node, key, parameter.type, type_)
            for key, parameter in zip(keys, parameters, strict=False)
        ]
        arguments += given_to(node, own, self.common, self.classes.findings, type_)
        list_refused(node, self._told(type_), self.common, self.classes.findings, type_)
        markers = (annotation(text, node.span) for text in node.markers)
        return m.Rebec(
            m.Type(type_),
            uncarry(node.name, TAKEN_NODES),
            tuple(b for b in bindings if b is not None),
            tuple(a for a in arguments if a is not None),
            tuple(a for a in markers if a is not None),
            node.source.within(node.span),
        )

    def _list_unreached(self, node: LaunchedNode, type_: str) -> None:
        """Lists subscriptions that no remapping leads to, and that have not their server's name."""
        for owner in (o for o in self.code.classes.values() if class_name(o.name) == type_):
            for taken in self.classes.roles[owner.name].taken:
                key = taken.topic.removeprefix("port/")
                if key.startswith(graph_name(taken.server)) or not key:
                    continue
                if is_reached(node, taken.topic, self._nodes()):
                    continue
                cpp, why = taken.function.cpp, f'nothing comes to the topic of "{taken.server}"'
                unread = Unread(cpp.span(taken.shim), why, "remap the topic of those who send")
                if all((f.span, f.why) != (unread.span, why) for f in self.classes.findings.all):
                    self.classes.findings.unreadable(cpp.source, unread, type_)

    def _nodes(self) -> tuple[LaunchedNode, ...]:
        return self.launch.nodes if self.launch is not None else ()

    def _lineage(self, name: str) -> list[m.ReactiveClass]:
        """A class and those above it, nearest first."""
        by_name = {c.name: c for c in self.read if isinstance(c, m.ReactiveClass)}
        found: list[m.ReactiveClass] = []
        at: str | None = name
        while at in by_name and by_name[at] not in found:
            found.append(by_name[at])
            at = by_name[at].extends
        return found

    def _started(self, node: LaunchedNode) -> tuple[str, list[str]] | None:
        """The class that a node's program makes a rebec of, and its private parameters."""
        names = {c.name for c in self.read}
        space, _, component = str(node.type).rpartition("::")  # loaded into a container
        for program in self.programs:
            if not space and node.type not in (program.name, program.stem):
                continue
            for made, keys in (*_made(program.main), *made_in(self.code, program.main)):
                if space and made.rpartition("::")[2] != component:
                    continue
                if class_name(made) in names:
                    return class_name(made), keys
        if self.python is not None and isinstance(node.type, str):
            return self.python.started(node.type)
        return None

    def _redirected(
        self, node: LaunchedNode, known: str, declared: Sequence[m.ReactiveClass]
    ) -> str | None:
        """The rebec that gets what is sent to a known rebec, if nothing else is done with that."""
        parts = [part for c in declared for member in c.members for part in m.walk(member)]
        sent_to = {id(part.target) for part in parts if isinstance(part, m.Call)}
        uses = (p for p in parts if isinstance(p, m.Name) and p.name == known)
        if all(id(use) in sent_to for use in uses):
            return redirected(node, known, self._nodes())
        return None

    def _bound(self, node: LaunchedNode, key: str, other: str | None) -> m.Expression | None:
        parameter = node.parameter(key)
        if parameter is None or not isinstance(parameter.value, str):
            return None
        span = parameter.source.within(parameter.span)
        return m.Name(uncarry(other or parameter.value, TAKEN_NODES), span)

    def _stored(self, type_: str) -> Sequence[Stored]:
        """The parameters of a node's own that its class stores."""
        if self.python is not None and type_ in self.python.own:
            return self.python.own[type_]
        owners = self.code.classes.values()
        owner = next((o for o in owners if class_name(o.name) == type_), None)
        return stored_in(self.code, self.classes.roles[owner.name], owner) if owner else ()

    def _told(self, type_: str) -> Sequence[OwnParameter]:
        """The parameters of a node's own that only people are told of."""
        if self.python is not None and type_ in self.python.told:
            return self.python.told[type_]
        owners = (o.name for o in self.code.classes.values() if class_name(o.name) == type_)
        return [p for name in owners for p in self.classes.roles[name].told]

    def _argument(
        self, node: LaunchedNode, key: str, type_: m.Type, within: str
    ) -> m.Expression | None:
        parameter = node.parameter(key)
        if parameter is None:
            unread = Unread(node.span, f"nothing gives the argument `{key}`", _GIVE)
            self.classes.findings.unreadable(node.source, unread, within)
            return zero_of(type_)  # in its place, so that the others keep theirs
        if (value := plain_value(parameter)) is None:
            return None
        if not self._is_taken(parameter, type_):
            self._list_other_kind(parameter, key, within)
            return zero_of(type_)
        if isinstance(value, str):
            read: m.Expression = m.Name(uncarry(value, TAKEN_NODES))
        else:
            read = literal_of(as_type(value, type_))
        return replace(read, span=parameter.source.within(parameter.span))

    def _is_taken(self, parameter: Parameter, type_: m.Type) -> bool:
        value = plain_value(parameter)
        widens = self.launch is not None and not speaks_ros_2(self.launch.sources[0])
        return value is None or is_taken(value, type_, widens)

    def _list_other_kind(self, parameter: Parameter, key: str, within: str) -> None:
        unread = Unread(parameter.span, f"the code reads another kind of value for `{key}`", _HINT)
        self.classes.findings.unreadable(parameter.source, unread, within)


def _is_given(parameters: Sequence[Parameter], wanted: Parameter) -> bool:
    """Whether a node is given a parameter of the same value, and of the same kind."""
    values = [p.value for p in parameters if p.name == wanted.name]
    return [*map(repr, values)] == [repr(wanted.value)]


def _made(function: CppFunction) -> Iterator[tuple[str, list[str]]]:
    """The objects that a program's `main` makes from a node, and the parameters it reads."""
    for type_, values in objects_in(function):
        calls = (c for value in values for c in calls_in(value) if c.name == "param")
        keys = (string_of(call.arguments[0]) for call in calls if call.arguments)
        yield type_, [key for key in keys if key is not None]
