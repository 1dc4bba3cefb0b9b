"""What the parts of a class are called in Python."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from rebsync.forward.class_names import ClassNames, alike, bases_first, publisher_place
from rebsync.forward.topics import Signature, signature
from rebsync.model import Parameter
from rebsync.names import carry, graph_name, unique
from rebsync.package import NodeClass, Package, Publisher, Subscription
from rebsync.records import dataclass
from rebsync.reserved import PYTHON_FUNCTIONS, PYTHON_MEMBERS, PYTHON_RESERVED, carry_local


@dataclass(slots=True)
class PyNames(ClassNames):
    """The names of one class in Python: `used` of its attributes, `globals` of its module."""

    globals: set[str] = field(default_factory=set)

    def local(self, name: str) -> str:
        """A local variable or parameter: the model's own name where it hides nothing."""
        taken = self.types | {t.removesuffix("_v") for t in self.types}
        return carry_local(name, PYTHON_RESERVED | taken, self.types)

    def hidden(self) -> frozenset[str]:
        """What a further local would hide: in the code or, as attributes, in the model."""
        taken = PYTHON_RESERVED - {"case"} | self.types | self.globals
        return frozenset({*taken, *self.used, *self.members, *self.env})

    def function(self, name: str, parameters: tuple[Parameter, ...]) -> str:
        """A handler or method: the model's own name where Python has one function of that name."""
        carried = carry(name, PYTHON_FUNCTIONS)
        suffix = self.apart.get(signature(name, parameters))
        return carried if suffix is None else f"{carried}__{suffix}"


def class_names(package: Package, class_types: Mapping[str, str]) -> dict[str, PyNames]:
    """The names of every class of a package."""
    found: dict[str, PyNames] = {}
    types = {m.name for m in package.messages} | {c.state.name for c in package.classes}
    types |= {s.type.rpartition("/")[2] for c in package.classes for s in c.sensors}
    types |= set(class_types.values())
    apart = _apart(package)
    for node in bases_first(package):
        names = PyNames(types=frozenset(types), apart=apart)
        for base in node.bases:
            names.inherit(found[base])
        _own(names, node)
        found[node.name] = names
    return found


def _apart(package: Package) -> dict[Signature, str]:
    """What tells overloads apart, of which Python has none: the types of their parameters."""
    same = alike(package, lambda name, _: name)
    return {wanted: "_".join(_word(t) for t in wanted[1]) or "void" for wanted in same}


def _word(type_: str) -> str:
    name, _, lengths = type_.partition("[")
    return "_".join([graph_name(name), *lengths.replace("]", "").split("[")]).rstrip("_")


def _own(names: PyNames, node: NodeClass) -> None:
    used = names.used
    used |= {names.function(f.name, f.parameters) for f in node.functions}
    used |= {names.function(s.server, s.parameters) for s in node.subscriptions}
    for name in (*(m.name for m in node.members), *(k.name for k in node.known)):
        names.members[name] = _member(name, used)
    for variable in node.env:
        names.env[variable.name] = _member(variable.name, used)
    for sensor in node.sensors:
        server = graph_name(sensor.server)
        names.sensors[sensor.server] = unique(f"_{server}_sensor", used)
        names.seen[sensor.server] = tuple(
            unique(f"seen_{server}", names.globals) for _ in sensor.draws
        )
    for subscription in node.subscriptions:
        _name_server(names, subscription)
    for publisher in node.publishers:
        _name_publisher(names, publisher)
    for send in node.self_sends:
        if send.key not in names.self_sends:
            names.self_sends[send.key] = unique(f"send_self_{send.key}", used)


def _member(name: str, used: set[str]) -> str:
    return unique(f"_{carry(name, PYTHON_MEMBERS)}", used)


def _name_server(names: PyNames, subscription: Subscription) -> None:
    key = subscription.key
    if key not in names.shims:
        names.shims[key] = unique(f"_receive_{key}", names.used)
        names.subscribers[key] = unique(f"_{key}_sub", names.used)
    if (offer := subscription.offer) is not None and key not in names.offers:
        kind = "action" if offer.is_action else "service"
        names.offers[key] = unique(f"_{key}_{kind}", names.used)


def server_constant(names: PyNames, key: str) -> str:
    """The name of a server's descriptor in the module of a class."""
    if key not in names.servers:
        names.servers[key] = unique(f"_{graph_name(key).upper()}", names.globals)
    return names.servers[key]


def _name_publisher(names: PyNames, publisher: Publisher) -> None:
    place, key = publisher_place(publisher), publisher.key
    if publisher.known is not None:
        known = graph_name(publisher.known)
        helper, member = f"send_{known}_{key}", f"_{known}_{key}_pub"
    else:
        target = graph_name(publisher.target)
        helper, member = f"send_{target}_{key}_to", f"_{target}_{key}_pubs"
    names.sends[place] = unique(helper, names.used)
    names.publishers[place] = unique(member, names.used)
