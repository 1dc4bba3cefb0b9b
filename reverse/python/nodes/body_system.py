"""Hand-written nodes in Python as reactive classes, and the rebecs that they are.

All bodies are read again until nothing new is learnt: what kinds of values variables hold, which
fields of messages are read, and which whole numbers may leave the model's `int`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field as with_default
from dataclasses import replace
from fractions import Fraction
from typing import TypeAlias

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.scope import Target
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.findings import COUNTS_ON, Findings
from rebsync.reverse.graph import Fact, Graph, ParameterFact, RateFact, TimerFact
from rebsync.reverse.nodes.node_joined import OBSERVER, Joined, Part
from rebsync.reverse.nodes.node_names import Names, class_word
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_times import Times
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.bodies.body_learnt import Asked, Learnt
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Key, PyTarget, PyUnit
from rebsync.reverse.python.bodies.body_units import (
    has_word,
    names_of,
    runs_in_threads,
    servers_of,
    units_of,
)
from rebsync.reverse.python.expressions.values import OTHER
from rebsync.reverse.python.nodes.body_classes import PyClass
from rebsync.reverse.python.nodes.body_listing import (
    list_endless,
    list_shared,
    list_unit,
    list_wiring,
)
from rebsync.reverse.python.nodes.body_started import NOTHING, Started, settings
from rebsync.reverse.python.nodes.escapes import list_escapes
from rebsync.reverse.python.nodes.handle_stores import list_handle_stores
from rebsync.reverse.python.nodes.module_model import list_module_model
from rebsync.reverse.python.nodes.own_arguments import list_own_arguments
from rebsync.reverse.python.nodes.spinning import list_unserved
from rebsync.reverse.python.values.node_effects import NodeEffects
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file

_MOST_ROUNDS = 60
# Rebecs of a unit that are read alike, by their number.
_Kind: TypeAlias = tuple[PyUnit, int]


@dataclass(frozen=True, slots=True)
class PyNodes:
    """The reactive classes of hand-written Python, and their rebecs.

    `joined` is how these and the nodes `beside` them are wired.
    """

    classes: tuple[m.ReactiveClass, ...] = ()
    rebecs: tuple[m.Rebec, ...] = ()
    units: tuple[PyUnit, ...] = ()
    servers: Mapping[str, Mapping[int, Server]] = with_default(default_factory=dict)
    joined: Joined | None = None


@dataclass(eq=False, slots=True)
class PySystem:
    """Reads the nodes of a package; `second` are the model's units of time in one second."""

    values: PyValues
    graph: Graph
    types: MessageTypes
    unit_of_time: Fraction
    findings: Findings
    is_people: Callable[[Fact], bool]
    only: str | None = None
    started: Started = NOTHING
    beside: Part = with_default(default_factory=Part.empty)
    form: PyForm = with_default(init=False)

    def __post_init__(self) -> None:
        self.form = PyForm(self.values.code, self.types, set_to=self.started.set_to)

    def read(self) -> PyNodes:
        """All of them; what has no place in the model is listed."""
        values = self.values
        units = units_of(values, self.graph, self.is_people, self.beside.classes)
        if not units:
            return PyNodes(joined=Joined.of([self.beside]))
        names = self.beside.names
        classes = {u.name: names.give(u.name if u.lineage else class_word(u.name)) for u in units}
        asked = [f for f in self.graph.facts if isinstance(f, ParameterFact)]
        launched = any(i.launched is not None for i in self.beside.instances)
        started = replace(self.started, others_start=launched or self.started.starts(units))
        instances = tuple(i for u in units for i in started.instances(u, units, names))
        served = {u.name: servers_of(values.code, u, Names.beside(())) for u in units}
        servers = {n: tuple({s.name: s for s in of.values()}.values()) for n, of in served.items()}
        apart = {i.name: settings(i, asked) for i in instances}
        joined = Joined.of([self.beside, Part(names, classes, instances, servers, apart)])
        times = Times.of(self.unit_of_time, joined.wiring.instances)
        round_ = _ReadingRound(self, values, units, joined, served, times)
        read = round_.settled()
        wanted = [u for u in units if self.only in (None, u.module.py.source.path)]
        found: list[m.ReactiveClass] = []
        for unit in wanted:
            found += self._classes(unit, round_, read)
            loops = max(len(each.loops) for each in _of(unit, read))
            threads = runs_in_threads(unit, values.code)
            list_unit(unit, served[unit.name], loops, threads, self.findings)
        readings = {u.name: _of(u, read)[0].reading for u in wanted}
        list_shared(wanted, readings, self.findings)
        list_endless(wanted, readings, self.findings)
        list_escapes(wanted, values, round_.effects, self._generated(), self.findings)
        list_handle_stores(wanted, values, self.findings)
        list_module_model(values, self._generated(), self.findings)
        list_own_arguments(values, self.findings)
        list_unserved(wanted, values, self.started.entries, served, self.findings)
        list_wiring(joined.wiring, {u.name for u in wanted}, self.findings)
        rebecs = tuple(round_.rebec(i) for i in instances if not i.idle)
        return PyNodes(tuple(found), rebecs, tuple(units), served, round_.said())

    def _classes(
        self, unit: PyUnit, round_: _ReadingRound, read: Mapping[_Kind, PyClass]
    ) -> Iterator[m.ReactiveClass]:
        """The classes of a unit: several have what is listed once."""
        for number, (kind, class_) in enumerate((k, c) for k, c in read.items() if k[0] is unit):
            class_.note()
            alike = round_.alike[kind]
            yield class_.reactive(round_.joined.class_of(alike[0]), round_.known(kind))
            new = class_.reading.findings
            if number:
                known = {(id(f.source), f.span, f.why) for f in self.findings.all}
                new.all = [f for f in new.all if (id(f.source), f.span, f.why) not in known]
                new.statements.clear()
            self.findings.take(new)

    def _generated(self) -> frozenset[str]:
        """The files that have generated code, which is read otherwise."""
        others = (f for f in self.graph.facts if not self.is_people(f))
        found = frozenset(f.site.place.source.path for f in others)
        sources = (module.py.source for module in self.values.code.modules.values())
        return found.union(s.path for s in sources if is_runtime_file(s))


def _of(unit: PyUnit, read: Mapping[_Kind, PyClass]) -> list[PyClass]:
    return [class_ for (of, _), class_ in read.items() if of is unit]


@dataclass(frozen=True, eq=False, slots=True)
class _Read:
    """A unit as it was read last: what it asked for, and on which variables it waits."""

    class_: PyClass
    answers: dict[Asked, object]
    pending: set[Key]


@dataclass(eq=False, slots=True)
class _ReadingRound:
    """Reads units, each once for every kind of its rebecs, until nothing is learnt any more."""

    system: PySystem
    values: PyValues
    units: Sequence[PyUnit]
    joined: Joined
    servers: Mapping[str, dict[int, Server]]
    times: Times
    alike: dict[_Kind, list[Instance]] = with_default(default_factory=dict)
    learnt: Learnt = with_default(default_factory=Learnt)
    before: int = 0
    effects: NodeEffects = with_default(init=False)
    _read: dict[_Kind, _Read] = with_default(default_factory=dict)
    # As no round changes them: by unit the names of variables, by kind all known rebecs.
    _names: dict[str, set[str]] = with_default(default_factory=dict)
    _known: dict[_Kind, list[tuple[str, str]]] = with_default(default_factory=dict)

    def __post_init__(self) -> None:
        self.effects = NodeEffects(self.values, self._classes)
        for unit in self.units:
            for number, alike in enumerate(self.joined.wiring.alike(unit.unit)):
                self.alike[unit, number] = alike

    @property
    def _classes(self) -> frozenset[Scope]:
        return frozenset(s for u in self.units for s in u.lineage)

    def settled(self) -> dict[_Kind, PyClass]:
        """The units as they are read when nothing changes any more."""
        for _ in range(_MOST_ROUNDS):
            self._all()
            if self.learnt.changes != self.before:
                continue
            pending = {k for read in self._read.values() for k in read.pending}
            waiting = {k for k in pending if k not in self.learnt.kinds}
            for key in waiting:
                self.learnt.join(key, OTHER)
            classes = [read.class_ for read in self._read.values()]
            if not waiting and not proved_otherwise(self.learnt, classes):
                break
        else:
            self._all()
        for read in self._read.values():
            self._note_counted(read.class_)
        return {kind: read.class_ for kind, read in self._read.items()}

    def _all(self) -> None:
        """Reads the units of which something is known now that they asked for."""
        self.before = self.learnt.changes
        for kind in self.alike:
            read = self._read.get(kind)
            if read is None or not self.learnt.is_same(read.answers):
                self.learnt.start()
                class_ = PyClass(self._reading(kind, Findings()))
                class_.read()
                learnt = self.learnt
                self._read[kind] = _Read(class_, learnt.answers, learnt.pending)

    def _reading(self, kind: _Kind, findings: Findings) -> Reading:
        unit, alike = kind[0], self.alike[kind]
        known = self.known(kind)
        own = self.servers[unit.name]
        if unit.name not in self._names:
            self._names[unit.name] = names_of(self.values.code, unit)
        return Reading(
            unit,
            self.values,
            self.learnt,
            self.system.types,
            alike[0],
            own,
            self._targets(alike[0], known),
            findings,
            self._names[unit.name],
            dict(self._periods(unit, alike, findings)),
            self.system.unit_of_time,
            self._classes,
            self.system.started.entries,
            used_names={n for n, _ in known} | {s.name for s in own.values()},
            form=self.system.form,
            effects=self.effects,
        )

    def _periods(
        self, unit: PyUnit, alike: Sequence[Instance], findings: Findings
    ) -> Iterator[tuple[int, int | None]]:
        for number, fact in enumerate(unit.unit.facts):
            if isinstance(fact, TimerFact | RateFact):
                yield number, self.times.units(fact, alike, findings, unit.name)

    def _note_counted(self, class_: PyClass) -> None:
        for name in sorted(class_.proof.counted):
            if name in class_.reading.places:
                source, span = class_.reading.places[name]
                why = f'"{name}" {COUNTS_ON}; the model\'s int ends at 2147483647'
                class_.reading.findings.assumed(source, span, why, within=class_.reading.unit.name)

    # --- wiring ---------------------------------------------------------------------------------

    def known(self, kind: _Kind) -> list[tuple[str, str]]:
        """Names and classes of the rebecs that a class sends to."""
        if kind not in self._known:
            unit = kind[0]
            servers = {s.name for s in self.servers[unit.name].values()}
            found = self.joined.known(
                self.alike[kind],
                lambda word: word in servers or has_word(unit, word),
                Names.beside(()),
            )
            self._known[kind] = [(name, class_) for name, class_, _ in found]
        return self._known[kind]

    def _targets(
        self, instance: Instance, known: Sequence[tuple[str, str]]
    ) -> dict[int, tuple[PyTarget, ...]]:
        wiring = self.joined.wiring
        own = wiring.place(instance)
        slots = wiring.known(instance)
        found: dict[int, list[PyTarget]] = {}
        for number, to, name in wiring.edges[instance.name]:
            other = wiring.instances[to].start.unit.name
            server = next(s for s in wiring.servers[other] if s.name == name)
            receiver = None if to == own else known[slots.index(to)][0]
            target = Target(receiver, name, self._fields(other, server))
            found.setdefault(number, []).append(PyTarget(other, target, {}))
        for number, observer in self.joined.observing(instance):
            found.setdefault(number, []).append(PyTarget(OBSERVER, observer, {}))
        return {n: tuple(t) for n, t in found.items()}

    def _fields(self, unit: str, server: Server) -> tuple[str, ...]:
        """The fields that a server gets, as far as the bodies say so by now."""
        if unit not in self.servers:
            return server.fields
        types = self.system.types.fields(server.type or "") or {}
        used = self.learnt.used_of(unit, server.name)
        return tuple(
            p
            for p, t in types.items()
            if p in used and t is not None and not self.learnt.is_open(unit, server.name, p)
        )

    def said(self) -> Joined:
        """The wiring with the fields that the bodies take."""
        fields = {
            (unit, server.name): self._fields(unit, server)
            for unit, served in self.servers.items()
            for server in served.values()
        }
        return replace(self.joined, fields=fields)

    def rebec(self, instance: Instance) -> m.Rebec:
        """The rebec of a node."""
        wiring = self.joined.wiring
        bindings = [m.Name(wiring.instances[n].name) for n in wiring.known(instance)]
        return m.Rebec(m.Type(self.joined.class_of(instance)), instance.name, tuple(bindings), ())


def proved_otherwise(learnt: Learnt, classes: Iterable[PyClass]) -> bool:
    """Takes note of what may leave the model's `int`; whether there is anything new."""
    before = learnt.changes
    for class_ in classes:
        for mark in class_.proof.failed:
            learnt.refuse(mark)
        for name in class_.proof.broken:
            key = class_.reading.state.get(name) or class_.reading.keys.get(name)
            if key is not None:
                learnt.join(key, OTHER)
    return learnt.changes != before
