"""What the parts of a class are called in C++."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from rebsync.forward.class_names import ClassNames, alike, bases_first, publisher_place
from rebsync.forward.cpp_types import stored_type
from rebsync.forward.topics import Signature, signature
from rebsync.model import Parameter
from rebsync.names import camel_case, carry, graph_name, unique
from rebsync.package import NodeClass, Package, Publisher, Subscription
from rebsync.records import dataclass
from rebsync.reserved import (
    OF_CONSTRUCTOR,
    RESERVED,
    RUNTIME_CONSTANTS,
    RUNTIME_MEMBERS,
    carry_local,
)


@dataclass(slots=True)
class CppNames(ClassNames):
    """The names of one class in C++, where servers and what a sensor saw are members as well."""

    callable: set[str] = field(default_factory=set)

    def local(self, name: str) -> str:
        """A local variable or parameter: the model's own name where it hides nothing."""
        return carry_local(name, RESERVED | self.types | self.callable, self.callable)

    def beside(self, name: str, parameters: tuple[Parameter, ...]) -> str:
        """A variable of a helper itself beside the parameters, which carry names of the model.

        What the model's names take, it leaves to them: none of those ends in an underscore.
        """
        taken = self.types | self.callable | {self.local(p.name) for p in parameters}
        return f"{name}_" if name in taken else name

    def hidden(self) -> frozenset[str]:
        """What a further local would hide, in the code or, as members are there, in the model."""
        return frozenset({*RESERVED, *self.types, *self.callable, *self.members, *self.env})

    def argument(self, name: str) -> str:
        """A parameter of the class's constructor."""
        return carry(name, RESERVED | self.types | self.callable | OF_CONSTRUCTOR)

    def function(self, name: str, parameters: tuple[Parameter, ...]) -> str:
        """A handler or method: the model's own name where C++ and the run-time part allow it."""
        name = self.apart.get(signature(name, parameters), name)
        return carry(name, RESERVED | self.types)

    def send_to_known(self, known: str, key: str) -> str:
        """The helper that sends one server's message to a known rebec."""
        return self.sends[(f"known {known}", key)]

    def send_to_any(self, class_name: str, key: str) -> str:
        """The helper that sends one server's message to a rebec given by name."""
        return self.sends[(f"any {class_name}", key)]


def class_names(package: Package, class_types: Mapping[str, str]) -> dict[str, CppNames]:
    """The names of every class of a package."""
    found: dict[str, CppNames] = {}
    types = {m.name for m in package.messages} | {c.state.name for c in package.classes}
    types |= set(class_types.values())
    apart = _apart(package)
    for node in bases_first(package):
        names = CppNames(used=set(RUNTIME_CONSTANTS), types=frozenset(types), apart=apart)
        for base in node.bases:
            _inherit(names, found[base])
        _own(names, node)
        found[node.name] = names
    return found


def _apart(package: Package) -> dict[Signature, str]:
    """Names for overloads that differ only in classes of rebecs, which are all text in C++."""
    same = alike(package, lambda name, given: (name, *(stored_type(p.type) for p in given)))
    return {
        wanted: f"{wanted[0]}_{'_'.join(wanted[1])}".replace("[", "_").replace("]", "")
        for wanted in same
    }


def _inherit(names: CppNames, base: CppNames) -> None:
    names.inherit(base)
    names.servers.update(base.servers)
    names.seen.update(base.seen)
    names.callable |= base.callable


def _own(names: CppNames, node: NodeClass) -> None:
    used = names.used
    methods = {names.function(f.name, f.parameters) for f in node.functions}
    used |= methods
    used |= {names.function(s.server, s.parameters) for s in node.subscriptions}
    for name in (*(m.name for m in node.members), *(k.name for k in node.known)):
        names.members[name] = _member(name, used)
    for variable in node.env:
        names.env[variable.name] = _member(variable.name, used)
    for sensor in node.sensors:
        names.sensors[sensor.server] = unique(f"{graph_name(sensor.server)}_sensor_", used)
        stem = f"seen{camel_case(sensor.server)}"
        names.seen[sensor.server] = tuple(unique(stem, used, "") for _ in sensor.draws)
    for subscription in node.subscriptions:
        _name_server(names, subscription)
    for publisher in node.publishers:
        _name_publisher(names, publisher)
    for send in node.self_sends:
        if send.key not in names.self_sends:
            names.self_sends[send.key] = unique(f"sendSelf{camel_case(send.key)}", used, "")
    names.callable |= methods | set(names.servers.values())
    names.callable |= {*names.sends.values(), *names.self_sends.values()}


def _member(name: str, used: set[str]) -> str:
    return unique(f"{carry(name, RUNTIME_MEMBERS)}_", used)


def _name_server(names: CppNames, subscription: Subscription) -> None:
    key = subscription.key
    if key not in names.servers:
        camel = camel_case(key)
        names.servers[key] = unique(f"k{camel}", names.used, "")
        names.shims[key] = unique(f"receive{camel}", names.used, "")
        names.subscribers[key] = unique(f"{key}_sub_", names.used)
    if (offer := subscription.offer) is not None and key not in names.offers:
        kind = "action" if offer.is_action else "service"
        names.offers[key] = unique(f"{key}_{kind}_", names.used)


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
