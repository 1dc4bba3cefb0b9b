"""Hand-written nodes of a package as reactive classes and a `main` with their rebecs."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import field
from fractions import Fraction

from rebsync import model as m
from rebsync.config import FILE_NAME, parse_config
from rebsync.literals import literal_of
from rebsync.records import dataclass
from rebsync.reverse.bodies.scope import Target
from rebsync.reverse.bodies.types.cpp_types import class_name
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.findings import Findings
from rebsync.reverse.graph import Fact, Graph, PublisherFact, SubscriptionFact
from rebsync.reverse.launch.launched import Launch
from rebsync.reverse.models.texts import TEXT, text_literal
from rebsync.reverse.nodes.node_bodies import Bodies, Common
from rebsync.reverse.nodes.node_bound import Helpers, note_bound, note_helpers, note_statics
from rebsync.reverse.nodes.node_classes import NodeClass, too_deep
from rebsync.reverse.nodes.node_components import executables
from rebsync.reverse.nodes.node_entries import note_entry
from rebsync.reverse.nodes.node_handed import note_handed
from rebsync.reverse.nodes.node_hidden import note_hidden
from rebsync.reverse.nodes.node_joined import Joined, Part
from rebsync.reverse.nodes.node_lifecycle import note_life_cycle
from rebsync.reverse.nodes.node_listing import FindingList
from rebsync.reverse.nodes.node_locks import note_locks
from rebsync.reverse.nodes.node_names import Names, class_word
from rebsync.reverse.nodes.node_parameters import ConstructorParameter
from rebsync.reverse.nodes.node_presence import STAND_IN, makes_generated
from rebsync.reverse.nodes.node_programs import Program
from rebsync.reverse.nodes.node_servers import servers
from rebsync.reverse.nodes.node_setup import Setup
from rebsync.reverse.nodes.node_signals import note_signals
from rebsync.reverse.nodes.node_signatures import Signatures
from rebsync.reverse.nodes.node_spinning import note_spinning
from rebsync.reverse.nodes.node_starts import first_functions, opening
from rebsync.reverse.nodes.node_state import State
from rebsync.reverse.nodes.node_taken import declares
from rebsync.reverse.nodes.node_texts import leave_out
from rebsync.reverse.nodes.node_times import Times
from rebsync.reverse.nodes.node_units import Start, Unit, UnitFacts, Units
from rebsync.reverse.nodes.node_unmade import list_beside, list_unmade
from rebsync.reverse.nodes.node_unmodelled import note_unmodelled
from rebsync.reverse.nodes.node_values import Instance, exact_seconds
from rebsync.reverse.nodes.node_views import all_units
from rebsync.reverse.nodes.node_wiring import Wiring, idle, instances
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.source import NOWHERE, Source


@dataclass(frozen=True, slots=True)
class Nodes:
    """The reactive classes of hand-written nodes, and their rebecs; `starts` says if any start."""

    classes: tuple[m.ReactiveClass, ...]
    rebecs: tuple[m.Rebec, ...]
    starts: bool

    def beside(self, classes: tuple[m.ReactiveClass, ...], rebecs: tuple[m.Rebec, ...]) -> Nodes:
        """These and the nodes of another language."""
        starts = self.starts or bool(rebecs)
        return Nodes((*self.classes, *classes), (*self.rebecs, *rebecs), starts)


def unit_of_time(files: Mapping[str, Source]) -> Fraction:
    """The seconds that a unit of the model's time takes, as the configuration says."""
    if FILE_NAME not in files:
        return Fraction(1)
    return exact_seconds(parse_config(files[FILE_NAME]).time_unit)


@dataclass(frozen=True, slots=True)
class CppNodes:
    """The nodes of a package's C++ before their bodies are read; `rebecs` are those that start."""

    programs: tuple[Program, ...]
    units: tuple[Unit, ...]
    starts: tuple[Start, ...]
    types: MessageTypes
    common: Common
    rebecs: tuple[Instance, ...]
    part: Part


@dataclass(slots=True)
class NodeSystem:
    """Reads the hand-written nodes of a package; `only` is the path of the one file asked for.

    Beside `generated` classes the programs that stand in for sensors are no nodes of the model.
    """

    code: Code
    graph: Graph
    files: Mapping[str, Source]
    launch: Launch | None
    package: str
    programs: tuple[Program, ...]
    findings: Findings
    only: str | None = None
    generated: bool = False
    _states: dict[str, State] = field(default_factory=dict)

    def find(self) -> CppNodes | None:
        """The nodes without their bodies, to be wired with those of other languages."""
        found = self.programs
        if self.generated:
            found = tuple(p for p in found if not p.name.endswith(STAND_IN))
        units, starts = all_units(self.code, self.graph, found, self.generated)
        if not units:
            return None
        types = MessageTypes.of(self.files, self.package)
        common = self._common(types, units)
        owners = frozenset(u.owner.name for u in units if u.owner is not None)
        for unit in units:
            names = Names.beside(())
            self._states[unit.name] = State(unit.code, unit, types, names, owners, common.enums)
        served = {u.name: servers(u, types, self._states[u.name].names) for u in units}
        names = Names.beside(())
        classes = {u.name: names.give(_class(u)) for u in units}
        known_as = executables(self.files)
        rebecs = instances(starts, self.launch, self.package, names, known_as)
        all_of = (*rebecs, *idle(units, starts, rebecs, names))
        part = Part(names, classes, all_of, served)
        return CppNodes(tuple(found), tuple(units), tuple(starts), types, common, rebecs, part)

    def read(self, found: CppNodes, joined: Joined) -> Nodes:
        """All of them, with whom they are `joined`; what has no place in the model is listed."""
        units, served = found.units, found.part.servers
        reading = Units(self.code, UnitFacts.of(self.graph), found.programs, self.generated)
        reader = _ClassReader(self, found, reading, joined)
        read = tuple(c for u in units if self._is_wanted(u) for c in reader.classes_of(u))
        listing = FindingList(self.findings, found.types)
        others = found.programs
        if self.generated:
            others = tuple(p for p in others if not makes_generated(self.code, p))
        for program in others:
            if not any(u.program is program for u in units) and self.only is None:
                listing.unit(reading.of_program(program), ())
        for unit in units:
            if self._is_wanted(unit):
                listing.unit(unit, served[unit.name])
        listing.wiring(joined.wiring, [u for u in units if self._is_wanted(u)])
        if self.only is None:
            list_beside(self.graph, units, self.findings)
            list_unmade(units, found.starts, self.code.files, self.findings)
        return Nodes(read, tuple(map(reader.rebec, found.rebecs)), bool(found.starts))

    def _is_wanted(self, unit: Unit) -> bool:
        if self.only is None:
            return True
        path = self.files[self.only].path
        headers = {c.cpp.source.path for c in unit.lineage[:1]}
        return path in unit.files | headers

    def _common(self, types: MessageTypes, units: Sequence[Unit]) -> Common:
        values: dict[str, set[int | None]] = {}
        for name, all_of in self.code.enumerators.items():
            for each in all_of:
                for prefix in {"", f"{each.enum}::", f"{each.scope}::"} - {"::"}:
                    values.setdefault(f"{prefix}{name}", set()).add(each.value)
        known: dict[str, int | str] = {
            n: v for n, vs in values.items() for v in vs if len(vs) == 1 and v is not None
        }
        enums = {e.enum for all_of in self.code.enumerators.values() for e in all_of if e.enum}
        wanted = {
            f.type
            for u in units
            for f in u.facts
            if isinstance(f, PublisherFact | SubscriptionFact) and isinstance(f.type, str)
        }
        messages = types.all_fields(wanted | types.mentioned(self.code.files))
        known |= types.constants()
        of_enums = frozenset(enums)
        return Common(known, of_enums, messages, frozenset(), Signatures(of_enums))

    def state(self, unit: Unit) -> State:
        """The variables of a unit."""
        return self._states[unit.name]


@dataclass(slots=True)
class _ClassReader:
    """Reads the classes of units, for each kind of their rebecs one."""

    system: NodeSystem
    found: CppNodes
    reading: Units
    joined: Joined
    times: Times = field(default_factory=lambda: Times(Fraction(1), Fraction(1)))
    _helpers: Helpers = field(default_factory=lambda: Helpers(()))
    _parameters: dict[str, tuple[list[ConstructorParameter], int]] = field(default_factory=dict)
    # What starts, by the ids of the units, and by what runs it: see `Start.process`.
    _of_units: dict[int, list[Start]] = field(default_factory=dict)
    _together: dict[Hashable, list[Start]] = field(default_factory=dict)
    _fields: dict[tuple[str, str], tuple[str, ...]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.times = Times.of(unit_of_time(self.system.files), self.wiring.instances)
        self._helpers = Helpers(self.found.part.classes)
        for start in self.found.starts:
            self._of_units.setdefault(id(start.unit), []).append(start)
            self._together.setdefault(start.process, []).append(start)

    @property
    def wiring(self) -> Wiring:
        return self.joined.wiring

    def _name(self, unit: Unit, alike: Sequence[Instance]) -> str:
        """The name of the class that some rebecs of a unit are of."""
        return self.joined.class_of(alike[0]) if alike else self.found.part.classes[unit.name]

    def classes_of(self, unit: Unit) -> Iterator[m.ReactiveClass]:
        """The classes that a unit becomes: one, or more if its rebecs are wired differently."""
        for number, alike in enumerate(self.wiring.alike(unit) or [[]]):
            findings = self.system.findings if not number else Findings()
            listed = findings.mark()
            try:
                read = self._class(unit, alike, findings)
            except RecursionError:
                findings.back_to(listed)
                read = self._too_deep(unit, alike, findings)
            yield read
            if number:
                known = {(f.span, f.why) for f in self.system.findings.all}
                new = [f for f in findings.all if (f.span, f.why) not in known]
                self.system.findings.all += new

    def _too_deep(self, unit: Unit, alike: list[Instance], findings: Findings) -> m.ReactiveClass:
        """The class of a unit that leads deeper than it can be read: others can still name it."""
        name = self._name(unit, alike)
        served = self.wiring.servers[unit.name]
        known = self._known(unit, alike, Names.beside({s.name for s in served}))
        return too_deep(name, unit, served, [(n, c) for n, c, _ in known], findings)

    def _class(self, unit: Unit, alike: list[Instance], findings: Findings) -> m.ReactiveClass:
        listed = findings.mark()
        broken, state = frozenset[str](), self.system.state(unit)
        while True:
            node, read = self._read(unit, alike, findings, broken)
            changed = node.bodies.changed_texts & state.variables.keys()
            if node.overflowing.broken <= broken and not changed:
                break
            broken |= node.overflowing.broken
            leave_out(state, changed)
            findings.back_to(listed)
        state.note(broken | node.overflowing.counted, findings, unit.name)
        note_life_cycle(unit, findings)
        note_bound(node.bodies)
        note_statics(node.bodies)
        note_hidden(node.bodies)
        note_entry(node.bodies, alike[0].start if alike else None)
        note_locks(node.bodies, self.system.generated)
        note_unmodelled(node.bodies)
        note_handed(node.bodies)
        note_spinning(node.bodies, alike[0].start if alike else None)
        note_signals(node.bodies, self.system.generated)
        note_helpers(node.bodies, self._helpers)
        return read

    def _read(
        self, unit: Unit, alike: list[Instance], findings: Findings, broken: frozenset[str]
    ) -> tuple[NodeClass, m.ReactiveClass]:
        """A class; `broken` are variables that hold more in the code than an `int` does."""
        state = self.system.state(unit)
        before, state.names = state.names, Names(state.names.used | set(state.variables))
        setup = self._setup(unit, alike, state, findings)
        start = alike[0].start if alike else None
        known = self._known(unit, alike, state.names)
        bodies = Bodies(
            unit.code,
            unit,
            self.wiring.servers[unit.name],
            state,
            setup,
            self.found.common,
            self._targets(alike, known),
            opening(unit, state, start, self._beside(unit, start)),
            findings,
            overflowing=broken,
        )
        name = self._name(unit, alike)
        node = NodeClass(name, bodies, [(n, c) for n, c, _ in known])
        read = node.read()
        state.names = before
        for index, instance in enumerate(alike):
            self._parameters[instance.name] = setup.parameters, index
        return node, read

    def _setup(self, unit: Unit, alike: list[Instance], state: State, findings: Findings) -> Setup:
        """What sets up the rebecs of one kind."""
        start = alike[0].start if alike else None
        first = first_functions(unit.code, unit, self._of_units.get(id(unit), ()))
        facts = unit.facts
        if start is not None and start.entry is not None and self._is_alone(start):
            first = [*first, start.entry]
            facts = (*facts, *self._facts_at(start))
        setup = Setup(
            unit.code,
            self.reading.facts,
            state,
            self.wiring.servers[unit.name],
            facts,
            alike,
            first,
            self.times,
            findings,
            unit.name,
            state.names,
        )
        setup.prepare()
        for function in unit.functions:
            state.outlive(function, set(), True)
        return setup

    def _beside(self, unit: Unit, start: Start | None) -> Sequence[Start]:
        """What runs together with a rebec of a unit, itself included."""
        if unit.program is not None:
            return self._together.get(unit.program.main.node.id, ())
        return self._together.get(start.process, ()) if start is not None else ()

    def _is_alone(self, start: Start) -> bool:
        """Whether an object is all that its program or nodelet has to do with ROS."""
        return start.made is not None and len(self._together.get(start.process, ())) == 1

    def _facts_at(self, start: Start) -> tuple[Fact, ...]:
        """What the program or nodelet that has an object asks for besides."""
        if start.program is not None:
            return self.reading.of_program(start.program).facts
        return tuple(f for f in self.system.graph.facts if f.site.owner == start.nodelet)

    # --- known rebecs ---------------------------------------------------------------------------

    def _known(self, unit: Unit, alike: list[Instance], names: Names) -> list[tuple[str, str, int]]:
        """Name, class and place among the slots of the rebecs that a class sends to."""
        if not any(self.wiring.known(i) for i in alike):
            return []
        bodies = [(f.cpp, f.body) for f in unit.functions if f.body is not None]
        parameters = {p.name for s in self.wiring.servers[unit.name] for p in s.parameters}

        def is_taken(name: str) -> bool:
            return name in parameters or any(declares(unit.code, *b, name) for b in bodies)

        return self.joined.known(alike, is_taken, names)

    def _targets(
        self, alike: list[Instance], known: list[tuple[str, str, int]]
    ) -> dict[int, tuple[Target, ...]]:
        """By publisher the receivers with their servers and the fields that they take."""
        if not alike:
            return {}
        instance, wiring = alike[0], self.wiring
        slots = {to: slot for slot, to in enumerate(wiring.known(instance))}
        found: dict[int, list[Target]] = {}
        for number, to, name in wiring.edges[instance.name]:
            unit = wiring.instances[to].start.unit.name
            receiver = known[slots[to]][0] if to in slots else None
            found.setdefault(number, []).append(Target(receiver, name, self._taken(unit, name)))
        for number, observer in self.joined.observing(instance):
            found.setdefault(number, []).append(observer)
        return {n: tuple(t) for n, t in found.items()}

    def _taken(self, unit: str, name: str) -> tuple[str, ...]:
        """The paths of the fields that a server gets, by its unit and its name."""
        if (unit, name) not in self._fields:
            server = next(s for s in self.wiring.servers[unit] if s.name == name)
            self._fields[unit, name] = self.joined.taken(unit, server)
        return self._fields[unit, name]

    # --- main -----------------------------------------------------------------------------------

    def rebec(self, instance: Instance) -> m.Rebec:
        """An instance with its known rebecs and the values of its constructor's parameters."""
        bindings = [m.Name(self.wiring.instances[n].name) for n in self.wiring.known(instance)]
        parameters, index = self._parameters.get(instance.name, ([], 0))
        arguments = [_argument(p, index) for p in parameters]
        class_ = self.joined.class_of(instance)
        known, given = tuple(bindings), tuple(arguments)
        node = instance.launched
        span = node.source.within(node.span) if node is not None else NOWHERE
        return m.Rebec(m.Type(class_), instance.name, known, given, (), span)


def _argument(parameter: ConstructorParameter, index: int) -> m.Expression:
    value = parameter.values[index] if index < len(parameter.values) else None
    if parameter.type == TEXT:
        return text_literal(value if isinstance(value, str) else "")
    if isinstance(value, bool | int | float | str):
        return literal_of(value)
    return literal_of({"boolean": False, "float": 0.0, "double": 0.0}.get(parameter.type.name, 0))


def _class(unit: Unit) -> str:
    return class_name(unit.owner.name) if unit.owner is not None else class_word(unit.name)
