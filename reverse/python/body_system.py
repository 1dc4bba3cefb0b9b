"""Hand-written nodes in Python as reactive classes, and the rebecs that they are.

All bodies are read again until nothing new is learnt: what kinds of values variables hold, which
fields of messages are read, and which whole numbers may leave the model's `int`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field as with_default
from fractions import Fraction

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.scope import Target
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.graph import Fact, Graph, RateFact, TimerFact
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.nodes.node_names import Names, class_word
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_times import Times
from rebsync.reverse.nodes.node_units import Start
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.nodes.node_wiring import Wiring
from rebsync.reverse.python.body_classes import PyClass
from rebsync.reverse.python.body_learnt import Asked, Learnt
from rebsync.reverse.python.body_listing import list_shared, list_unit, list_wiring
from rebsync.reverse.python.body_reading import Reading
from rebsync.reverse.python.body_scope import OTHER, Key, PyTarget, PyUnit
from rebsync.reverse.python.body_units import has_word, names_of, servers_of, units_of
from rebsync.reverse.python.py_values import Values

_MOST_ROUNDS = 60


@dataclass(frozen=True, slots=True)
class PyNodes:
    """The reactive classes of hand-written Python, and their rebecs."""

    classes: tuple[m.ReactiveClass, ...] = ()
    rebecs: tuple[m.Rebec, ...] = ()
    units: tuple[PyUnit, ...] = ()
    servers: Mapping[str, Mapping[int, Server]] = with_default(default_factory=dict)


@dataclass(eq=False, slots=True)
class PySystem:
    """Reads the nodes of a package; `second` are the model's units of time in one second."""

    values: Values
    graph: Graph
    types: MessageTypes
    unit_of_time: Fraction
    findings: Findings
    is_people: Callable[[Fact], bool]
    only: str | None = None
    launch: Launch | None = None

    def read(self) -> PyNodes:
        """All of them; what has no place in the model is listed."""
        values = self.values
        units = units_of(values, self.graph, self.is_people)
        if not units:
            return PyNodes()
        names = Names.beside(())
        classes = {u.name: names.give(u.name if u.lineage else class_word(u.name)) for u in units}
        instances = [self._instance(u, units, names) for u in units]
        servers = {u.name: servers_of(values.code, u, Names.beside(())) for u in units}
        wiring = Wiring(
            tuple(instances),
            {n: tuple({s.name: s for s in of.values()}.values()) for n, of in servers.items()},
        )
        times = Times.of(self.unit_of_time, instances)
        round_ = _Round(self, values, units, wiring, servers, classes, times)
        read = round_.settled()
        wanted = [u for u in units if self._is_wanted(u)]
        found = []
        for unit in wanted:
            read[unit.name].note()
            found.append(read[unit.name].reactive(classes[unit.name], round_.known(unit)))
            self.findings.take(read[unit.name].reading.findings)
            list_unit(unit, servers[unit.name], len(read[unit.name].loops), self.findings)
        readings = {u.name: read[u.name].reading for u in wanted}
        list_shared(wanted, readings, self.findings)
        list_wiring(wiring, {u.name for u in wanted}, self.findings)
        rebecs = tuple(round_.rebec(u) for u in units)
        return PyNodes(tuple(found), rebecs, tuple(units), servers)

    def _instance(self, unit: PyUnit, units: Sequence[PyUnit], names: Names) -> Instance:
        """The rebec of a unit, as a launch file starts it or by itself."""
        path = unit.module.py.source.path.rpartition("/")[2]
        launched = self.launch.nodes if self.launch is not None else ()
        nodes = [n for n in launched if n.type in (path, path.removesuffix(".py"))]
        for other in nodes[1:]:
            why = "the same program is started again: the model has one of its rebecs"
            self.findings.unreadable(other.source, Unread(other.span, why), unit.name)
        node = next((n.name for n in nodes[:1] if isinstance(n.name, str)), unit.node)
        alone = sum(u.module is unit.module for u in units) == 1 or not unit.lineage
        wish = node if alone else unit.lineage[0].name
        name = names.give(wish[:1].lower() + wish[1:])
        start = Start(unit.unit, None, None)
        return Instance(start, name, node, nodes[0] if nodes else None, self.launch)

    def _is_wanted(self, unit: PyUnit) -> bool:
        return self.only in (None, unit.module.py.source.path)


@dataclass(frozen=True, eq=False, slots=True)
class _Read:
    """A unit as it was read last: what it asked for, and on which variables it waits."""

    class_: PyClass
    answers: dict[Asked, object]
    pending: set[Key]


@dataclass(eq=False, slots=True)
class _Round:
    """Reads units until nothing is learnt any more."""

    system: PySystem
    values: Values
    units: Sequence[PyUnit]
    wiring: Wiring
    servers: Mapping[str, dict[int, Server]]
    classes: Mapping[str, str]
    times: Times
    learnt: Learnt = with_default(default_factory=Learnt)
    before: int = 0
    _read: dict[str, _Read] = with_default(default_factory=dict)
    # By unit, as no round changes them: the names of variables, and all known rebecs.
    _names: dict[str, set[str]] = with_default(default_factory=dict)
    _known: dict[str, list[tuple[str, str]]] = with_default(default_factory=dict)

    def settled(self) -> dict[str, PyClass]:
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
        return {name: read.class_ for name, read in self._read.items()}

    def _all(self) -> None:
        """Reads the units of which something is known now that they asked for."""
        self.before = self.learnt.changes
        for unit in self.units:
            read = self._read.get(unit.name)
            if read is None or not self.learnt.is_same(read.answers):
                self.learnt.start()
                class_ = PyClass(self._reading(unit, Findings()))
                class_.read()
                learnt = self.learnt
                self._read[unit.name] = _Read(class_, learnt.answers, learnt.pending)

    def _reading(self, unit: PyUnit, findings: Findings) -> Reading:
        known = self.known(unit)
        own = self.servers[unit.name]
        if unit.name not in self._names:
            self._names[unit.name] = names_of(self.values.code, unit)
        instance = self._instance(unit)
        return Reading(
            unit,
            self.values,
            self.learnt,
            self.system.types,
            instance,
            own,
            self._targets(unit, instance, known),
            findings,
            self._names[unit.name],
            dict(self._periods(unit, instance, findings)),
            self.system.unit_of_time,
            frozenset(s for u in self.units for s in u.lineage),
            used_names={n for n, _ in known} | {s.name for s in own.values()},
        )

    def _periods(
        self, unit: PyUnit, instance: Instance, findings: Findings
    ) -> Iterator[tuple[int, int | None]]:
        for number, fact in enumerate(unit.unit.facts):
            if isinstance(fact, TimerFact | RateFact):
                yield number, self.times.units(fact, [instance], findings, unit.name)

    def _note_counted(self, class_: PyClass) -> None:
        for name in sorted(class_.proof.counted):
            if name in class_.reading.places:
                source, span = class_.reading.places[name]
                why = f'"{name}" counts on without end; the model\'s int ends at 2147483647'
                class_.reading.findings.approximated(
                    source, span, why, within=class_.reading.unit.name
                )

    # --- wiring ---------------------------------------------------------------------------------

    def _instance(self, unit: PyUnit) -> Instance:
        return next(i for i in self.wiring.instances if i.start.unit is unit.unit)

    def known(self, unit: PyUnit) -> list[tuple[str, str]]:
        """Names and classes of the rebecs that a class sends to."""
        if unit.name not in self._known:
            self._known[unit.name] = self._rebecs_of(unit)
        return self._known[unit.name]

    def _rebecs_of(self, unit: PyUnit) -> list[tuple[str, str]]:
        servers = {s.name for s in self.servers[unit.name].values()}
        names = Names.beside(())
        found = []
        for place in self.wiring.known(self._instance(unit)):
            to = self.wiring.instances[place]
            is_taken = to.name in servers or has_word(unit, to.name)
            wish = f"{to.name}_rebec" if is_taken else to.name
            found.append((names.give(wish), self.classes[to.start.unit.name]))
        return found

    def _targets(
        self, unit: PyUnit, instance: Instance, known: Sequence[tuple[str, str]]
    ) -> dict[int, tuple[PyTarget, ...]]:
        own = self.wiring.place(instance)
        slots = self.wiring.known(instance)
        found: dict[int, list[PyTarget]] = {}
        for number, to, name in self.wiring.edges[instance.name]:
            other = self.wiring.instances[to].start.unit.name
            server = next(s for s in self.servers[other].values() if s.name == name)
            types = self.system.types.fields(server.type or "") or {}
            used = self.learnt.used_of(other, name)
            paths = tuple(
                p
                for p, t in types.items()
                if p in used and t is not None and not self.learnt.is_open(other, name, p)
            )
            receiver = None if to == own else known[slots.index(to)][0]
            target = Target(receiver, name, paths)
            found.setdefault(number, []).append(PyTarget(other, target, {}))
        return {n: tuple(t) for n, t in found.items()}

    def rebec(self, unit: PyUnit) -> m.Rebec:
        """The rebec of a unit."""
        instance = self._instance(unit)
        bindings = [m.Name(self.wiring.instances[n].name) for n in self.wiring.known(instance)]
        return m.Rebec(m.Type(self.classes[unit.name]), instance.name, tuple(bindings), ())


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
