"""From the files of a package, or some of them, to a model."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from rebsync import model as m
from rebsync.literals import initial_of, literal_of
from rebsync.names import TAKEN_NODES, graph_name, uncarry
from rebsync.package import Value
from rebsync.records import dataclass
from rebsync.reserved import RESERVED_GLOBALS
from rebsync.reverse.analysis.evaluation_order import out_of_order
from rebsync.reverse.bodies.cpp_types import class_name, type_of
from rebsync.reverse.bodies.overloads import Served
from rebsync.reverse.bodies.written import annotation
from rebsync.reverse.build.built import unbuilt
from rebsync.reverse.build.field_order import in_order
from rebsync.reverse.build.manifests import name_in
from rebsync.reverse.calls.ros_calls import Asking
from rebsync.reverse.files.packages import CODE
from rebsync.reverse.files.python_files import SETUP, is_launch, is_python
from rebsync.reverse.findings import Finding, Findings, Grade
from rebsync.reverse.generated.env_values import (
    as_type,
    constant,
    marked_type,
    plain_value,
    shaped,
    type_of_value,
)
from rebsync.reverse.generated.one_definition import defined_again
from rebsync.reverse.generated.own_parameters import Stored, given_to
from rebsync.reverse.generated.parameters import objects_in, odd_arguments
from rebsync.reverse.generated.ros1_classes import Classes
from rebsync.reverse.generated.ros1_kept import Memory, read_with
from rebsync.reverse.generated.ros1_messages import own_messages
from rebsync.reverse.generated.ros1_names import stored_in, variable_name
from rebsync.reverse.generated.ros2_words import made_in
from rebsync.reverse.graph import Graph
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.nodes.node_components import executables
from rebsync.reverse.nodes.node_joined import Joined, Part
from rebsync.reverse.nodes.node_lacking import marked_lacking
from rebsync.reverse.nodes.node_launch import system_of
from rebsync.reverse.nodes.node_presence import is_generated, may_have_nodes
from rebsync.reverse.nodes.node_programs import Program, programs, with_nodes
from rebsync.reverse.nodes.node_system import Nodes, NodeSystem
from rebsync.reverse.syntax.cpp_calls import calls_in, string_of
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.reverse.syntax.unparsed import unparsed
from rebsync.source import NOWHERE, Source

if TYPE_CHECKING:
    from rebsync.reverse.python.recovery import PythonCode, PythonPart

_MANIFEST = "package.xml"
_TIME_UNIT = "/mailbox/time_unit"
_CODE = tuple(sorted(CODE))
_UNBUILT = "no program of the package is made of this file"
_NEEDED = "no target of the build compiles this file, and the package needs what it defines"


@dataclass(frozen=True, slots=True)
class Extracted:
    """The model of some files, what in them is not in it, and how many statements each body has.

    `asking` are the calls to ROS of its C++, of which `graph` is made when it is first asked for;
    `in_python` those of its Python.
    """

    model: m.Model
    findings: tuple[Finding, ...]
    statements: tuple[tuple[str, int], ...]
    asking: Asking = field(default_factory=lambda: Asking(Code()), compare=False)
    in_python: Graph = field(default_factory=Graph, compare=False)

    @property
    def graph(self) -> Graph:
        """What the code asks of ROS."""
        return Graph(self.asking.graph.facts + self.in_python.facts)


def extract(
    files: Mapping[str, Source], only: str | None = None, memory: Memory | None = None
) -> Extracted:
    """The model that files say together; paths are relative to the package, with slashes.

    With `only` the classes that this file declares or defines, read with the help of the others;
    or, if it is a launch file, the system that this one starts. `memory` knows what generated
    classes said before: of these only what an edit can have to do with is read again.
    """
    findings = Findings()
    files = _built(files, only, findings)
    code = _in_cpp(files, findings)
    asking = Asking(code)
    package = _package(files)
    asked = only if only is not None and is_launch(only) else None
    only = only if asked is None else None
    started = programs(code, files)
    system = system_of(files, package, asked, started)
    launch = system.launch if system is not None else None
    listed, declared = Findings(), own_messages(files)
    in_python = _in_python(files, listed, declared)
    messages = in_order(declared, in_python.orders() if in_python is not None else ())
    types = {t.rpartition("/")[2]: tuple(f.values()) for t, f in messages.items()}
    served = Served(in_python.classes.families() if in_python is not None else {}, types)
    classes = Classes(code, findings, messages, _unit_of_time(launch), served)
    wanted = _classes_in(code, files[only].path) if only is not None else None
    read = classes.read(wanted) if memory is None else read_with(memory, classes, wanted)
    for owner in classes.chosen(wanted):
        findings.all += defined_again(code, owner)
    of_model = {owner.name for owner in classes.chosen(wanted)}
    findings.all += (f for p in started for f in odd_arguments(code, p.main, of_model))
    generated = is_generated(code)
    of_cpp = None
    if not generated or may_have_nodes(code, asking, started):
        graph = asking.graph
        found = with_nodes(started, graph)
        of_nodes = launch if system is not None and system.starts else None
        of_cpp = NodeSystem(code, graph, files, of_nodes, package, found, findings, only, generated)
    people = of_cpp.find() if of_cpp is not None else None
    part = people.part if people is not None else Part.empty()
    python = None
    if in_python is not None:
        python = _python(in_python, files, listed, only, package, launch, part, started, classes)
    joined = python.nodes.joined if python is not None else None
    nodes = Nodes((), (), False)
    if of_cpp is not None and people is not None:
        nodes = of_cpp.read(people, joined if joined is not None else Joined.of([part]))
    is_made = bool(python is not None and python.classes)
    if system is not None and only is None and (read or nodes.classes or is_made):
        by_hand = bool(nodes.classes)
        system.note(findings, python is not None and not by_hand and python.starts(system.launch))
    findings.take(listed)
    if python is not None:
        read = (*read, *python.classes)
        nodes = nodes.beside(python.nodes.classes, python.nodes.rebecs)
    made = _System(code, classes, read, launch if only is None else None, started, python)
    main = _main(made, nodes, only is not None and len(files) > 1)
    findings.all += out_of_order((*read, *nodes.classes), findings.ordered)
    of_people = tuple(marked_lacking(c, findings.all) for c in nodes.classes)
    model = m.Model(tuple(made.heads() if read else ()), (*read, *of_people), main)
    statements = tuple(findings.statements.items())
    asked_for = python.graph if python is not None else Graph()
    return Extracted(model, tuple(findings.all), statements, asking, asked_for)


def _built(files: Mapping[str, Source], only: str | None, findings: Findings) -> dict[str, Source]:
    """The files but for those that no program is made of, which are listed."""
    found = unbuilt(files)
    for path in sorted(found.left - {only}):
        grade, why = Grade.UNBUILT, _UNBUILT
        if path in found.needed:
            grade, why = Grade.UNREADABLE, _NEEDED
        findings.all.append(Finding(grade, files[path], NOWHERE, why))
    left = found.left - found.needed - {only}
    return {path: source for path, source in files.items() if path not in left}


def _in_cpp(files: Mapping[str, Source], findings: Findings) -> Code:
    """The files of C++, parsed."""
    trees = [parse(source) for path, source in sorted(files.items()) if path.endswith(_CODE)]
    findings.all += [finding for tree in trees for finding in unparsed(tree)]
    return Code.of(trees)


def _in_python(
    files: Mapping[str, Source],
    findings: Findings,
    messages: Mapping[str, Mapping[str, m.Type | None]],
) -> PythonCode | None:
    """The files of Python, if there are any, and what of them is generated."""
    code = ((path, source) for path, source in files.items() if path != SETUP)
    sources = {path: source for path, source in code if is_python(path, source)}
    if not sources:
        return None
    from rebsync.reverse.python.recovery import PythonCode

    return PythonCode.of(sources, findings, messages)


def _python(
    code: PythonCode,
    files: Mapping[str, Source],
    findings: Findings,
    only: str | None,
    package: str,
    launch: Launch | None,
    beside: Part,
    programs: tuple[Program, ...],
    in_cpp: Classes,
) -> PythonPart:
    """What the files of Python say; what of them is not in the model is listed."""
    from rebsync.reverse.python.recovery import fields_by_name, read_python

    names = {name for p in programs for name in (p.name, p.stem)}
    names = names.union(*executables(files).values())
    code.classes.messages, served = fields_by_name(in_cpp.messages), in_cpp.served
    return read_python(code, findings, only, files, package, launch, beside, names, served)


def _main(generated: _System, nodes: Nodes, is_part: bool) -> m.Main | None:
    """The rebecs of all nodes; None where only part of a system is asked for, or nothing starts."""
    main = generated.main()
    if is_part or (main is None and not nodes.starts):
        return None
    return m.Main((*(main.rebecs if main is not None else ()), *nodes.rebecs))


def _package(files: Mapping[str, Source]) -> str:
    """The name of the package, empty where no manifest says it."""
    return name_in(files[_MANIFEST]) or "" if _MANIFEST in files else ""


def _classes_in(code: Code, path: str) -> set[str]:
    """The classes of which a file has at least a part."""
    found = {c.name for c in code.classes.values() if c.cpp.source.path == path}
    parts = (f for all_of in code.definitions.values() for f in all_of)
    return found | {f.owner for f in parts if f.cpp.source.path == path and f.owner}


def _unit_of_time(launch: Launch | None) -> Fraction:
    """The seconds that a unit of time takes in generated nodes."""
    for parameter in launch.parameters if launch is not None else ():
        value = parameter.value
        if parameter.name != _TIME_UNIT or not isinstance(value, (int, float)):
            continue
        if 0 < value < math.inf:
            return Fraction(repr(value))
    return Fraction(1)


@dataclass(frozen=True, slots=True)
class _System:
    """What code and launch file say together: constants and rebecs."""

    code: Code
    classes: Classes
    read: tuple[m.ReactiveClass | m.Interface, ...]
    launch: Launch | None
    programs: tuple[Program, ...]
    python: PythonPart | None = None

    @property
    def common(self) -> tuple[Parameter, ...]:
        """The parameters that are under no node."""
        return self.launch.parameters if self.launch is not None else ()

    # --- constants ------------------------------------------------------------------------------

    def heads(self) -> Iterator[m.Env]:
        """The constants of the model: all global parameters but those of the run-time part."""
        used = dict(self._used())
        every = (s.parameter for o in self.read for s in self._stored(o.name))
        own = {f"/{p.key}" for p in every if p.for_all}
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
        nodes = self.launch.nodes if self.launch else ()
        return RESERVED_GLOBALS | {n.name for n in nodes if isinstance(n.name, str)}

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
        bindings = [self._bound(node, f"knownrebecs/{graph_name(k)}") for k in known]
        constructors = [c for c in declared[0].members if isinstance(c, m.Constructor)]
        own = self._stored(type_)
        count = len(keys) + len(own)
        parameters = next((c.parameters for c in constructors if len(c.parameters) == count), ())
        arguments = [
            self._argument(node, key, parameter.type)
            for key, parameter in zip(keys, parameters, strict=False)
        ]
        arguments += given_to(node, own, self.common, self.classes.findings, type_)
        markers = (annotation(text, node.span) for text in node.markers)
        return m.Rebec(
            m.Type(type_),
            uncarry(node.name, TAKEN_NODES),
            tuple(b for b in bindings if b is not None),
            tuple(a for a in arguments if a is not None),
            tuple(a for a in markers if a is not None),
            node.source.within(node.span),
        )

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
        for program in self.programs:
            if node.type not in (program.name, program.stem):
                continue
            for made, keys in (*_made(program.main), *made_in(self.code, program.main)):
                if class_name(made) in names:
                    return class_name(made), keys
        if self.python is not None and isinstance(node.type, str):
            return self.python.started(node.type)
        return None

    def _bound(self, node: LaunchedNode, key: str) -> m.Expression | None:
        parameter = node.parameter(key)
        if parameter is None or not isinstance(parameter.value, str):
            return None
        span = parameter.source.within(parameter.span)
        return m.Name(uncarry(parameter.value, TAKEN_NODES), span)

    def _stored(self, type_: str) -> Sequence[Stored]:
        """The parameters of a node's own that its class stores."""
        if self.python is not None and type_ in self.python.own:
            return self.python.own[type_]
        owners = self.code.classes.values()
        owner = next((o for o in owners if class_name(o.name) == type_), None)
        return stored_in(self.code, self.classes.roles[owner.name], owner) if owner else ()

    def _argument(self, node: LaunchedNode, key: str, type_: m.Type) -> m.Expression | None:
        parameter = node.parameter(key)
        value = plain_value(parameter) if parameter is not None else None
        if parameter is None or value is None:
            return None
        if isinstance(value, str):
            read: m.Expression = m.Name(uncarry(value, TAKEN_NODES))
        else:
            read = literal_of(as_type(value, type_))
        return replace(read, span=parameter.source.within(parameter.span))


def _made(function: CppFunction) -> Iterator[tuple[str, list[str]]]:
    """The objects that a program's `main` makes from a node, and the parameters it reads."""
    for type_, values in objects_in(function):
        calls = (c for value in values for c in calls_in(value) if c.name == "param")
        keys = (string_of(call.arguments[0]) for call in calls if call.arguments)
        yield type_, [key for key in keys if key is not None]
