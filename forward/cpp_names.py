"""What the parts of a class are called in C++."""

from __future__ import annotations

from dataclasses import dataclass, field

from rebsync.names import CPP_KEYWORDS, camel_case, carry, graph_name, unique
from rebsync.package import NodeClass, Package, Publisher, Sensor, Subscription

_RUNTIME_MEMBERS = frozenset({"mailbox", "drive", "node", "state"})
_RUNTIME_FUNCTIONS = frozenset({"after", "choose", "deadline", "divide", "mailbox", "narrow"}) | {
    *("publishState", "remainder", "text", "to", "unused"),
}


def local_name(name: str) -> str:
    """A local variable or parameter: the model's own name where C++ allows it."""
    return carry(name, CPP_KEYWORDS)


def function_name(name: str) -> str:
    """A handler or method: the model's own name where C++ and the run-time part allow it."""
    return carry(name, CPP_KEYWORDS | _RUNTIME_FUNCTIONS)


@dataclass(slots=True)
class CppNames:
    """The names of one class, those of its ancestors included."""

    members: dict[str, str] = field(default_factory=dict)
    env: dict[str, str] = field(default_factory=dict)
    sends: dict[tuple[str, str], str] = field(default_factory=dict)
    publishers: dict[tuple[str, str], str] = field(default_factory=dict)
    self_sends: dict[str, str] = field(default_factory=dict)
    servers: dict[str, str] = field(default_factory=dict)
    shims: dict[str, str] = field(default_factory=dict)
    subscribers: dict[str, str] = field(default_factory=dict)
    sensors: dict[str, str] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)

    def send_to_known(self, known: str, key: str) -> str:
        """The helper that sends one server's message to a known rebec."""
        return self.sends[(f"known {known}", key)]

    def send_to_any(self, class_name: str, key: str) -> str:
        """The helper that sends one server's message to a rebec given by name."""
        return self.sends[(f"any {class_name}", key)]


def publisher_place(publisher: Publisher) -> tuple[str, str]:
    """The key of a publisher in `CppNames`."""
    if publisher.known is not None:
        return f"known {publisher.known}", publisher.key
    return f"any {publisher.target}", publisher.key


def class_names(package: Package) -> dict[str, CppNames]:
    """The names of every class of a package."""
    found: dict[str, CppNames] = {}
    for node in sorted(package.classes, key=lambda c: _depth(package, c)):
        names = CppNames()
        for base in node.bases:
            _inherit(names, found[base])
        _own(names, node)
        found[node.name] = names
    return found


def _depth(package: Package, node: NodeClass) -> int:
    return 1 + max((_depth(package, package.node_class(b)) for b in node.bases), default=0)


def _inherit(names: CppNames, base: CppNames) -> None:
    names.members.update(base.members)
    names.env.update(base.env)
    names.sends.update(base.sends)
    names.publishers.update(base.publishers)
    names.self_sends.update(base.self_sends)
    names.servers.update(base.servers)
    names.shims.update(base.shims)
    names.subscribers.update(base.subscribers)
    names.sensors.update(base.sensors)
    names.used |= base.used


def _own(names: CppNames, node: NodeClass) -> None:
    used = names.used
    used |= {function_name(f.name) for f in node.functions}
    used |= {function_name(s.server) for s in node.subscriptions}
    for name in (*(m.name for m in node.members), *(k.name for k in node.known)):
        names.members[name] = _member(name, used)
    for variable in node.env:
        names.env[variable.name] = _member(variable.name, used)
    for sensor in node.sensors:
        names.sensors[sensor.server] = unique(f"{graph_name(sensor.server)}_sensor_", used)
    for subscription in node.subscriptions:
        _name_server(names, subscription)
    for publisher in node.publishers:
        _name_publisher(names, publisher)
    for send in node.self_sends:
        if send.key not in names.self_sends:
            names.self_sends[send.key] = unique(f"sendSelf{camel_case(send.key)}", used, "")


def _member(name: str, used: set[str]) -> str:
    return unique(f"{carry(name, _RUNTIME_MEMBERS)}_", used)


def _name_server(names: CppNames, subscription: Subscription) -> None:
    key = subscription.key
    if key not in names.servers:
        camel = camel_case(key)
        names.servers[key] = unique(f"k{camel}", names.used, "")
        names.shims[key] = unique(f"receive{camel}", names.used, "")
        names.subscribers[key] = unique(f"{key}_sub_", names.used)


def _name_publisher(names: CppNames, publisher: Publisher) -> None:
    place = publisher_place(publisher)
    known, key = publisher.known, camel_case(publisher.key)
    if known is not None:
        helper, member = (
            f"send{camel_case(known)}{key}",
            f"{graph_name(known)}_{publisher.key}_pub_",
        )
    else:
        target = camel_case(publisher.target)
        helper, member = (
            f"send{target}{key}To",
            f"{graph_name(publisher.target)}_{publisher.key}_pubs_",
        )
    names.sends[place] = unique(helper, names.used, "")
    names.publishers[place] = unique(member, names.used)


def seen_functions(sensor: Sensor) -> tuple[str, ...]:
    """The user's functions of a sensor: one for each `?(...)` of its server."""
    stem = f"seen{camel_case(sensor.server)}"
    return tuple(stem if index == 0 else f"{stem}{index + 1}" for index in range(len(sensor.draws)))
