"""From files of Python to classes of the model, what starts them, and what they ask of ROS."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import field as with_default
from functools import partial

from rebsync import model as m
from rebsync.names import carry
from rebsync.package import Value
from rebsync.records import dataclass
from rebsync.reserved import NO_PYTHON_CLASSES
from rebsync.reverse.bodies.overloads import Served
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.files.packages import BESIDE
from rebsync.reverse.files.python_files import SETUP
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.generated.messages import NO_MESSAGES, OwnMessages
from rebsync.reverse.generated.own_parameters import OwnParameter, Stored
from rebsync.reverse.graph import (
    Callback,
    Callbacks,
    Fact,
    Graph,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
)
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.nodes.node_joined import Part
from rebsync.reverse.nodes.node_system import unit_of_time
from rebsync.reverse.python.generated.classes import ModelClasses
from rebsync.reverse.python.generated.env import integer_constants
from rebsync.reverse.python.generated.import_effects import (
    list_definition_effects,
    list_import_effects,
    list_setup_effects,
)
from rebsync.reverse.python.generated.parameters import constant, parameter_read
from rebsync.reverse.python.generated.py_types import class_name
from rebsync.reverse.python.generated.sensor_effects import list_sensor_effects
from rebsync.reverse.python.nodes.body_started import Started, entries_of, is_module, scripts_of
from rebsync.reverse.python.nodes.body_system import PyNodes, PySystem
from rebsync.reverse.python.values.py_calls import owner_of
from rebsync.reverse.python.values.py_hooks import hooks_in
from rebsync.reverse.python.values.py_unmodelled import whole_graph
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import field, named, parse, text_of, unparsed
from rebsync.source import Source

_WHY = "what this belongs to is no node of the model: only what it asks of ROS is read"
_HINT = "--format json tells what it asks of ROS"
_STAND_IN = "_stand_in"

# The constants that classes read: by key the type, the name in the model, and the default.
Used = tuple[str, tuple[m.Type, str, "Value | None"]]


@dataclass(frozen=True, eq=False)
class PythonPart:
    """What files of Python say: classes of the model, and all that they ask of ROS.

    `scripts` are the modules of the programs that the package installs, by their names, `arguments`
    the parameters that constructors read themselves, `own` those of them that they store, and
    `told` those that only people are told of.
    """

    graph: Graph
    classes: tuple[m.ReactiveClass | m.Interface, ...] = ()
    used: tuple[Used, ...] = ()
    code: PyCode | None = None
    nodes: PyNodes = PyNodes()
    scripts: Mapping[str, str] = with_default(default_factory=dict)
    arguments: Mapping[str, Sequence[str]] = with_default(default_factory=dict)
    own: Mapping[str, Sequence[Stored]] = with_default(default_factory=dict)
    told: Mapping[str, Sequence[OwnParameter]] = with_default(default_factory=dict)

    def starts(self, launch: Launch) -> bool:
        """Whether a launch file starts any class of these files."""
        types = (n.type for n in launch.nodes)
        return any(isinstance(t, str) and self.started(t) is not None for t in types)

    def started(self, program: str) -> tuple[str, list[str]] | None:
        """The class that a program makes a rebec of, and its private parameters."""
        names = {c.name for c in self.classes}
        for call, scope in self.code.calls if self.code is not None else ():
            path = scope.py.source.path.rpartition("/")[2]
            called = text_of(field(call, "function"))
            made = class_name(called)
            is_own = made in names and carry(made, NO_PYTHON_CLASSES) == called
            module = self.scripts.get(program)
            if module is None:
                # that a program of this name is not installed is told by itself
                runs = program == path.removesuffix(".py") or (not self.scripts and program == path)
            else:
                runs = is_module(scope.py.source.path, module)
            if runs and is_own:
                arguments = named(field(call, "arguments"))
                reads = filter(None, map(parameter_read, arguments))
                keys = [read.key for read in reads if read.is_own]
                return made, [*keys, *self.arguments.get(made, ())]
        return None


@dataclass(frozen=True, eq=False)
class PythonCode:
    """The files of Python of a package by their paths, parsed, and what of them is generated."""

    sources: Mapping[str, Source]
    code: PyCode
    values: PyValues
    classes: ModelClasses

    @staticmethod
    def of(
        sources: Mapping[str, Source],
        findings: Findings,
        messages: OwnMessages = NO_MESSAGES,
    ) -> PythonCode:
        """Parses them; `messages` are the package's message types."""
        trees = [parse(source, path.startswith(BESIDE)) for path, source in sorted(sources.items())]
        findings.all += [f for py in trees for f in unparsed(py)]
        code = PyCode.of(trees)
        return PythonCode(
            sources,
            code,
            PyValues(code),
            ModelClasses(code, findings, by_name(messages)),
        )

    def hears_others(self) -> bool:
        """Whether a file that is not of the run-time part has to do with messages of std_msgs."""
        sources = (s for s in self.sources.values() if not is_runtime_file(s))
        return any(word in s.text for s in sources for word in ("std_msgs", "AnyMsg"))

    def orders(self) -> Iterator[tuple[str, tuple[str, ...]]]:
        """The fields of message types in the orders in which generated code hands them on."""
        for roles in self.classes.roles.values():
            yield from roles.orders


def by_name(messages: OwnMessages) -> OwnMessages:
    """Message types by their names without the package."""
    fields = {type_.rpartition("/")[2]: of for type_, of in messages.fields.items()}
    constants = {type_.rpartition("/")[2]: of for type_, of in messages.constants.items()}
    return OwnMessages(fields, messages.signed, constants)


def read_python(
    python: PythonCode,
    findings: Findings,
    only: str | None = None,
    files: Mapping[str, Source] | None = None,
    package: str = "",
    launch: Launch | None = None,
    beside: Part | None = None,
    programs: Collection[str] = (),
    served: Served | None = None,
) -> PythonPart:
    """What some files say; each callback whose body is not in the model is listed.

    With `only` the classes of that file; `files` are all that the package has, and `launch` what
    starts its nodes. `beside` are its hand-written nodes in C++, whose `programs` are none of
    Python's, and `served` what its generated classes in both languages serve.
    """
    values, classes = python.values, python.classes
    graph = whole_graph(values)
    asked = python.sources.get(only) if only is not None else None
    path = asked.path if asked is not None else None
    known, unit = MessageTypes.of(files or {}, package), unit_of_time(files or {})
    classes.served = served if served is not None else Served(classes.families())
    classes.constants = integer_constants(classes.env(), launch)
    read = classes.read(path) if asked is not None or only is None else ()
    if read and only is None and SETUP in (files or {}):
        findings.all += unparsed(parse((files or {})[SETUP]))
        list_setup_effects((files or {})[SETUP], findings)
    own = {(o.name, o.py.source.path) for o in classes.owners}
    if read and only is None:
        list_import_effects(python.sources, python.code, _read_paths(python), findings)
        for module in {id(o.module): o.module for o in classes.owners}.values():
            names = {o.name for o in classes.owners if o.module is module}
            list_definition_effects(module.py.source, names, findings)
        list_sensor_effects(python.code, _read_paths(python), known, findings)
    is_people = partial(_is_people, own=own)
    scripts = scripts_of(files or {})
    entries = entries_of(files or {})
    started = Started(launch, package, scripts, frozenset(programs), entries=entries)
    system = PySystem(values, graph, known, unit, findings, is_people, path, started)
    system.beside = beside if beside is not None else Part.empty()
    nodes = system.read()
    _list_callbacks(graph, own, findings, path, nodes)
    _list_hooks(values, own, findings, path)
    used = tuple((e.key, (e.type, e.name, constant(e.default))) for e in classes.env())
    arguments, stored = classes.arguments(), classes.own()
    told = {class_name(o.name): classes.roles[id(o)].told for o in classes.owners}
    return PythonPart(graph, read, used, python.code, nodes, scripts, arguments, stored, told)


def _read_paths(python: PythonCode) -> frozenset[str]:
    """The files of which the statements at the top are read otherwise: of classes and run-time."""
    runtime = {s.path for s in python.sources.values() if is_runtime_file(s)}
    return frozenset(runtime | {o.py.source.path for o in python.classes.owners})


# --- what is not read ---------------------------------------------------------------------------


def _list_callbacks(
    graph: Graph,
    own: Collection[tuple[str, str]],
    findings: Findings,
    path: str | None,
    nodes: PyNodes,
) -> None:
    listed = {
        (s.callback.place.source.path, s.callback.place.span.start)
        for servers in nodes.servers.values()
        for s in servers.values()
    }
    people = (f for f in graph.facts if _is_people(f, own))
    for callback in (c for f in people for c in _callbacks(f) if isinstance(c, Callback)):
        place = callback.place
        key = place.source.path, place.span.start
        if key not in listed and path in (None, place.source.path):
            listed.add(key)
            unread = Unread(place.span, _WHY, _HINT)
            findings.unreadable(place.source, unread, callback.name or "lambda")


def _list_hooks(
    values: PyValues, own: Collection[tuple[str, str]], findings: Findings, path: str | None
) -> None:
    for hook in hooks_in(values):
        source = hook.place.source
        if path in (None, source.path) and not _is_made(owner_of(hook.within), source, own):
            why = f'"{hook.name}" calls functions of the node in ways that the model does not have'
            within = hook.functions or owner_of(hook.within) or ""
            findings.unreadable(source, Unread(hook.place.span, why, ""), within)


def _is_people(fact: Fact, own: Collection[tuple[str, str]]) -> bool:
    """Whether a call stands in no generated code."""
    return not _is_made(fact.site.owner, fact.site.place.source, own)


def _is_made(owner: str | None, source: Source, own: Collection[tuple[str, str]]) -> bool:
    """Whether code is generated: that of a class of the model, of what runs it, of a stand-in."""
    is_stand_in = source.path.removesuffix(".py").endswith(_STAND_IN)
    return (owner or "", source.path) in own or is_runtime_file(source) or is_stand_in


def _callbacks(fact: Fact) -> Callbacks:
    return fact.callbacks if isinstance(fact, (SubscriptionFact, TimerFact, ServiceFact)) else ()
