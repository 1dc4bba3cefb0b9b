"""What the parts of a class are called, whatever the language: tables, and who inherits them."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping
from dataclasses import field

from rebsync.forward.topics import Signature, signature
from rebsync.model import Parameter
from rebsync.package import NodeClass, Package, Publisher
from rebsync.records import dataclass

Place = tuple[str, str]


@dataclass(slots=True)
class ClassNames:
    """The names of one class, those of its ancestors included; `used` are those of its scope."""

    members: dict[str, str] = field(default_factory=dict)
    env: dict[str, str] = field(default_factory=dict)
    sends: dict[Place, str] = field(default_factory=dict)
    publishers: dict[Place, str] = field(default_factory=dict)
    self_sends: dict[str, str] = field(default_factory=dict)
    servers: dict[str, str] = field(default_factory=dict)
    shims: dict[str, str] = field(default_factory=dict)
    subscribers: dict[str, str] = field(default_factory=dict)
    offers: dict[str, str] = field(default_factory=dict)
    sensors: dict[str, str] = field(default_factory=dict)
    seen: dict[str, tuple[str, ...]] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)
    types: frozenset[str] = frozenset()
    apart: Mapping[Signature, str] = field(default_factory=dict)

    def inherit(self, base: ClassNames) -> None:
        """Takes over what is a member of an object, and so of the class below as well."""
        self.members.update(base.members)
        self.env.update(base.env)
        self.sends.update(base.sends)
        self.publishers.update(base.publishers)
        self.self_sends.update(base.self_sends)
        self.shims.update(base.shims)
        self.subscribers.update(base.subscribers)
        self.offers.update(base.offers)
        self.sensors.update(base.sensors)
        self.used |= base.used


def publisher_place(publisher: Publisher) -> Place:
    """The key of a publisher in `ClassNames`."""
    if publisher.known is not None:
        return f"known {publisher.known}", publisher.key
    return f"any {publisher.target}", publisher.key


def bases_first(package: Package) -> list[NodeClass]:
    """The classes of a package, each after those that it extends."""
    return sorted(package.classes, key=lambda c: _depth(package, c))


def _depth(package: Package, node: NodeClass) -> int:
    return 1 + max((_depth(package, package.node_class(b)) for b in node.bases), default=0)


def alike(
    package: Package, like: Callable[[str, tuple[Parameter, ...]], Hashable]
) -> Iterator[Signature]:
    """The servers and methods, declared differently, that `like` does not tell apart."""
    groups: dict[Hashable, dict[Signature, None]] = {}
    for node in package.classes:
        declared = [(s.server, s.parameters) for s in node.subscriptions]
        declared += [(f.name, f.parameters) for f in node.functions]
        for name, parameters in declared:
            groups.setdefault(like(name, parameters), {})[signature(name, parameters)] = None
    for group in groups.values():
        if len(group) > 1:
            yield from group
