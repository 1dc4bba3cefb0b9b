"""Which rebecs there are, and who receives what they publish."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace

from rebsync.records import dataclass
from rebsync.reverse.findings import NOT_SENT
from rebsync.reverse.graph import (
    NodeFact,
    ParameterFact,
    PublisherFact,
    RateFact,
    SubscriptionFact,
    TimerFact,
)
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.libraries.routines import Access
from rebsync.reverse.nodes.node_names import Names
from rebsync.reverse.nodes.node_programs import Program
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_times import period_of
from rebsync.reverse.nodes.node_units import Start, Unit
from rebsync.reverse.nodes.node_values import Instance, of_object
from rebsync.reverse.unknowns import Text

# By the publisher's place in the facts of its unit, a receiver and its server.
Edge = tuple[int, int, str]


def instances(
    starts: Sequence[Start],
    launch: Launch | None,
    package: str,
    names: Names,
    known_as: Mapping[str, frozenset[str]],
) -> tuple[Instance, ...]:
    """The rebecs that a launch file starts, or one of each kind without it.

    `known_as` are the names by which launch files start components, by their classes.
    """
    if launch is None:
        return tuple(_alone(starts, names))
    found = []
    for node in launch.nodes:
        of_node = [s for s in starts if _runs(node, s, package, known_as)]
        for start in of_node:
            node = node.named(_named_itself(start))
            plain = node.name if isinstance(node.name, str) else "node"
            wish = plain if len(of_node) == 1 else f"{plain}_{_own(start)}"
            space = node.namespace if isinstance(node.namespace, str) else ""
            given = names.give(wish, f"{space.strip('/')}_{wish}")
            found.append(Instance(start, given, plain, node, launch))
    return tuple(found)


def idle(
    units: Sequence[Unit], starts: Sequence[Start], found: Sequence[Instance], names: Names
) -> Iterator[Instance]:
    """An instance of each unit that nobody starts."""
    started = {id(i.start.unit) for i in found}
    for unit in units:
        if id(unit) not in started:
            start = next((s for s in starts if s.unit is unit), Start(unit, None, None))
            yield from (replace(i, idle=True) for i in _alone([start], names))


def _alone(starts: Sequence[Start], names: Names) -> Iterator[Instance]:
    together = Counter(s.process for s in starts)
    for start in starts:
        program = start.program
        named = program.node.name if program is not None and program.node is not None else None
        own = _named_itself(start)
        node = named if isinstance(named, str) and named else _program(program) or start.unit.name
        node = own or node
        wish = node if own or together[start.process] == 1 else _own(start)
        yield Instance(start, names.give(wish[:1].lower() + wish[1:]), node.strip("/"))


def _named_itself(start: Start) -> str:
    """The name that a class gives the node that it is, as those of rclcpp do; or empty."""
    facts = (f for f in start.unit.facts if isinstance(f, NodeFact) and f.nodelet is None)
    names = [f.name for f in facts if f.site.owner in start.unit.names and f.name is not None]
    own = of_object(start, names[0]) if len(names) == 1 else None
    return own if isinstance(own, str) else ""


def _program(program: Program | None) -> str:
    return program.name if program is not None else ""


def _own(start: Start) -> str:
    """What tells an object from the others of its program."""
    if start.made is not None and start.made.variable:
        return start.made.variable.removeprefix("this->").rstrip("_")
    return start.unit.owner.name if start.unit.owner is not None else start.unit.name


def _runs(
    node: LaunchedNode, start: Start, package: str, known_as: Mapping[str, frozenset[str]]
) -> bool:
    """Whether a tag of a launch file starts this."""
    if start.program is None and node.nodelet is None:
        of_package = not package or node.package in (package, "")
        return of_package and node.type in known_as.get(start.nodelet or "", ())
    if node.nodelet is not None:
        name = node.nodelet.class_name
        plain = name.replace("::", "/").rpartition("/")[2] if name is not None else None
        return start.program is None and plain == start.nodelet
    if start.program is None or (package and node.package not in (package, "")):
        return False
    return node.type in (start.program.name, start.program.stem)


# --- who receives what --------------------------------------------------------------------------


@dataclass(slots=True)
class Wiring:
    """The edges from publishers to servers, and the kinds of rebecs that are wired alike."""

    instances: tuple[Instance, ...]
    servers: Mapping[str, tuple[Server, ...]]
    apart: Mapping[str, object] = field(default_factory=dict)
    edges: dict[str, tuple[Edge, ...]] = field(default_factory=dict)
    kinds: dict[str, int] = field(default_factory=dict)
    _places: dict[str, int] = field(default_factory=dict)
    # By the names of rebecs, those that each sends to; by the ids of units, the rebecs of each.
    _known: dict[str, tuple[int, ...]] = field(default_factory=dict)
    _of_units: dict[int, list[Instance]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._places = {instance.name: n for n, instance in enumerate(self.instances)}
        listening = self._listening()
        for instance in self.instances:
            self.edges[instance.name] = tuple(self._edges(instance, listening))
            self._known[instance.name] = self._receivers(instance)
            self._of_units.setdefault(id(instance.start.unit), []).append(instance)
        self._sort()

    def _listening(self) -> dict[str, list[tuple[object, int, str]]]:
        """By topic its types, and the rebecs and servers that receive it."""
        found: dict[str, list[tuple[object, int, str]]] = {}
        for index, instance in enumerate(self.instances):
            for server in self.servers[instance.start.unit.name]:
                for fact in server.subscriptions:
                    topic = instance.topic(fact.topic)
                    if isinstance(topic, str):
                        found.setdefault(topic, []).append((server.type, index, server.name))
        return found

    def _edges(
        self, instance: Instance, listening: Mapping[str, Sequence[tuple[object, int, str]]]
    ) -> Iterator[Edge]:
        for number, fact in enumerate(instance.start.unit.facts):
            topic = instance.topic(fact.topic) if isinstance(fact, PublisherFact) else None
            if not isinstance(fact, PublisherFact) or not isinstance(topic, str):
                continue
            for type_, to, server in listening.get(topic, ()):
                if self.instances[to].idle and not instance.idle:
                    continue
                if type_ == fact.type or not _both(type_, fact.type):
                    yield number, to, server

    def _sort(self) -> None:
        """Rebecs of a unit are of one kind if they send alike to rebecs of equal kinds.

        Their timers have the same periods, the same parameters are set, and nothing else sets
        them `apart`.
        """
        apart = {
            i.name: (i.start.unit.name, self.apart.get(i.name), *_settings(i))
            for i in self.instances
        }
        first = {mark: n for n, mark in enumerate(dict.fromkeys(apart.values()))}
        self.kinds = {name: first[mark] for name, mark in apart.items()}
        sent = {i.name: tuple(self._slotted(i)) for i in self.instances}
        while True:
            marks = {name: (kind, self._shape(sent[name])) for name, kind in self.kinds.items()}
            numbers = {mark: n for n, mark in enumerate(dict.fromkeys(marks.values()))}
            finer = {name: numbers[mark] for name, mark in marks.items()}
            done = len(set(finer.values())) == len(set(self.kinds.values()))
            self.kinds = finer
            if done:
                return

    def _slotted(self, instance: Instance) -> Iterator[tuple[int, str, int, str]]:
        """The edges of a rebec, each receiver by its name and its slot, -1 for itself."""
        slots = {to: slot for slot, to in enumerate(self.known(instance))}
        for number, to, server in self.edges[instance.name]:
            yield number, self.instances[to].name, slots.get(to, -1), server

    def _shape(self, sent: Iterable[tuple[int, str, int, str]]) -> tuple[object, ...]:
        return tuple((number, self.kinds[to], slot, server) for number, to, slot, server in sent)

    def place(self, instance: Instance) -> int:
        """Where among the rebecs one is."""
        return self._places[instance.name]

    def known(self, instance: Instance) -> tuple[int, ...]:
        """The rebecs that one sends to, itself left out, in the order of its publishers."""
        return self._known[instance.name]

    def _receivers(self, instance: Instance) -> tuple[int, ...]:
        own = self.place(instance)
        edges = self.edges[instance.name]
        return tuple(dict.fromkeys(to for _, to, _ in edges if to != own))

    def alike(self, unit: Unit) -> list[list[Instance]]:
        """The rebecs of a unit, those of one kind together."""
        found: dict[int, list[Instance]] = {}
        for instance in self._of_units.get(id(unit), ()):
            found.setdefault(self.kinds[instance.name], []).append(instance)
        return list(found.values())


def _settings(instance: Instance) -> Iterator[str]:
    """What rebecs of one class have in common besides."""
    for fact in instance.start.unit.facts:
        match fact:
            case TimerFact() | RateFact():
                yield str(period_of(instance, fact))
            case ParameterFact(default=None, access=Access.GET | Access.HAS):
                yield str(instance.parameter(fact.name) is not None)


def _both(one: object, other: object) -> bool:
    return isinstance(one, str) and isinstance(other, str)


def unheard(wiring: Wiring) -> Iterator[tuple[Instance, PublisherFact]]:
    """The publishers whose messages no rebec receives."""
    for instance in wiring.instances:
        sent = {number for number, _, _ in wiring.edges[instance.name]}
        for number, fact in enumerate(instance.start.unit.facts):
            if isinstance(fact, PublisherFact) and number not in sent:
                yield instance, fact


def unfed(wiring: Wiring) -> Iterator[tuple[Instance, Server, SubscriptionFact]]:
    """The subscriptions to which no rebec publishes, each with the server that gets its messages.

    What nobody starts publishes to others alone that nobody starts.
    """
    fed = {
        (to, server)
        for instance in wiring.instances
        for _, to, server in wiring.edges[instance.name]
        if not instance.idle or wiring.instances[to].idle
    }
    started, topics = (
        _published(i for i in wiring.instances if not i.idle),
        _published(wiring.instances),
    )
    for index, instance in enumerate(wiring.instances):
        published = topics if instance.idle else started
        for server in wiring.servers[instance.start.unit.name]:
            for fact in server.subscriptions:
                if (index, server.name) not in fed or instance.topic(fact.topic) not in published:
                    yield instance, server, fact


def nobody_subscribes(topic: str) -> str:
    """Why what is published to a topic is not in the model."""
    return f'nobody in these files subscribes to "{topic}": {NOT_SENT}'


def nobody_publishes(topic: str) -> str:
    """Why messages of a topic are not in the model."""
    return f'nobody in these files publishes "{topic}": the model gets no such message'


def _published(instances: Iterable[Instance]) -> set[Text]:
    """The topics to which some rebecs publish."""
    facts = ((i, f) for i in instances for f in i.start.unit.facts)
    return {i.topic(f.topic) for i, f in facts if isinstance(f, PublisherFact)}
