"""The hand-written nodes of a package in all its languages, wired together."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field

from rebsync.records import dataclass
from rebsync.reverse.bodies.scope import Target
from rebsync.reverse.graph import PublisherFact
from rebsync.reverse.nodes.node_names import Names
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.nodes.node_wiring import Wiring

Fields = Mapping[tuple[str, str], tuple[str, ...]]
Observed = Mapping[str, tuple[str, ...]]
# Who gets what is published to topics that are observed: a rebec that no class knows.
OBSERVER = "observer"


@dataclass(frozen=True, slots=True)
class Part:
    """The nodes of one language, before their bodies are read.

    `classes` are the names in the model of the units by their own; `settings` say what tells
    rebecs of one unit apart besides who they send to, by the names of the rebecs. `observed` are
    paths of fields, by topic, whose values are sent to the `OBSERVER` too.
    """

    names: Names
    classes: Mapping[str, str]
    instances: tuple[Instance, ...]
    servers: Mapping[str, tuple[Server, ...]]
    settings: Mapping[str, object] = field(default_factory=dict)
    observed: Observed = field(default_factory=dict)

    @staticmethod
    def empty() -> Part:
        """No nodes at all."""
        return Part(Names.beside(()), {}, (), {})


@dataclass(frozen=True, slots=True)
class Joined:
    """All rebecs with the kinds that they are of, and the classes that these become.

    `fields` are those of messages that servers get, by unit and server, where bodies that were
    read say so; of others the servers do.
    """

    wiring: Wiring
    kinds: Mapping[int, str]
    fields: Fields = field(default_factory=dict)
    observed: Observed = field(default_factory=dict)

    @staticmethod
    def of(parts: Iterable[Part]) -> Joined:
        """The parts share the names that are taken, and no two have a unit of one name."""
        together = list(parts)
        instances = tuple(i for part in together for i in part.instances)
        served = {n: s for part in together for n, s in part.servers.items()}
        settings = {n: s for part in together for n, s in part.settings.items()}
        observed = {t: paths for part in together for t, paths in part.observed.items()}
        apart = {i.name: (settings.get(i.name), tuple(_seen(i, observed))) for i in instances}
        wiring = Wiring(instances, served, apart)
        kinds = {k: c for part in together for k, c in _kinds(part, wiring)}
        return Joined(wiring, kinds, observed=observed)

    def observing(self, instance: Instance) -> Iterator[tuple[int, Target]]:
        """By the places of a rebec's publishers, what of their messages the observer gets."""
        for number, topic in _seen(instance, self.observed):
            yield number, Target(OBSERVER, topic, self.observed[topic])

    def class_of(self, instance: Instance) -> str:
        """The class of the model that a rebec is of."""
        return self.kinds[self.wiring.kinds[instance.name]]

    def taken(self, unit: str, server: Server) -> tuple[str, ...]:
        """The paths of the fields that a server gets."""
        return self.fields.get((unit, server.name), server.fields)

    def known(
        self, alike: Sequence[Instance], is_taken: Callable[[str], bool], names: Names
    ) -> list[tuple[str, str, int]]:
        """Name, class and place among the slots of the rebecs that rebecs of one kind send to."""
        found = []
        slots = [self.wiring.known(i) for i in alike]
        for slot, several in enumerate(zip(*slots, strict=True)):
            to = self.wiring.instances[several[0]]
            class_ = self.class_of(to)
            wish = to.name if len(set(several)) == 1 else class_[:1].lower() + class_[1:]
            if is_taken(wish):
                wish = f"{wish}_rebec"
            found.append((names.give(wish), class_, slot))
        return found


def _seen(instance: Instance, observed: Observed) -> Iterator[tuple[int, str]]:
    """The publishers of a rebec to topics that are observed, by their places, and these topics."""
    for number, fact in enumerate(instance.start.unit.facts):
        topic = instance.topic(fact.topic) if isinstance(fact, PublisherFact) else None
        if isinstance(topic, str) and topic in observed:
            yield number, topic


def _kinds(part: Part, wiring: Wiring) -> Iterator[tuple[int, str]]:
    """The class of each kind: a unit whose rebecs are wired differently becomes several."""
    kinds: dict[str, dict[int, None]] = {}
    for instance in part.instances:
        of_unit = kinds.setdefault(instance.start.unit.name, {})
        of_unit[wiring.kinds[instance.name]] = None
    for unit, class_ in part.classes.items():
        for number, kind in enumerate(kinds.get(unit, ())):
            yield kind, class_ if not number else part.names.give(class_)
