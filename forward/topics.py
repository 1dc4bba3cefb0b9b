"""Which topic and message type every message server has (mapping: one each per server).

Servers that redefine one another across classes and interfaces are one topic family: they share
the message type, which is named after the class that declares the server first.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from rebsync.model import (
    Interface,
    MessageServer,
    Model,
    Name,
    Parameter,
    ReactiveClass,
    Type,
    walk,
)
from rebsync.names import (
    camel_case,
    carry,
    field_names,
    free_name,
    graph_name,
    header_stem,
    message_name,
    unique,
)
from rebsync.package import Field, MessageType, StateType
from rebsync.records import dataclass
from rebsync.reserved import (
    NO_CLASSES,
    RESPONSE_FIELD,
    RUNTIME_CLASSES,
    RUNTIME_FIELDS,
    RUNTIME_TOPICS,
    STATE_FIELDS,
)
from rebsync.static import Analysis
from rebsync.static.symbols import BuiltinSymbol, ClassInfo, ServerSymbol

Signature = tuple[str, tuple[str, ...]]


@dataclass(frozen=True, slots=True)
class ServerTopic:
    """One family of servers: its key (last segment of the topic), type, and port annotation.

    `offer` is the type of the service or action that it is offered as, if it is.
    """

    root: str
    name: str
    key: str
    parameters: tuple[Parameter, ...]
    message: MessageType
    port: bool
    offer: str | None


def signature(name: str, parameters: tuple[Parameter, ...]) -> Signature:
    """What tells a server from its overloads."""
    return name, tuple(str(p.type) for p in parameters)


def declared_servers(declaration: ReactiveClass | Interface) -> tuple[MessageServer, ...]:
    """The servers that a class or interface declares itself."""
    if isinstance(declaration, Interface):
        return declaration.servers
    return tuple(m for m in declaration.members if isinstance(m, MessageServer))


class Topics:
    """The topic family of every server of a model."""

    def __init__(self, model: Model, analysis: Analysis) -> None:
        self._analysis = analysis
        self._order = {c.name: i for i, c in enumerate(model.classes)}
        self._declared: dict[tuple[str, Signature], MessageServer] = {
            (c.name, signature(s.name, s.parameters)): s
            for c in model.classes
            for s in declared_servers(c)
        }
        self._signatures = {
            name: dict.fromkeys(signature(s.name, s.declaration.parameters) for s in info.servers)
            for name, info in analysis.classes.items()
        }
        self._families = self._unite(model)
        self.class_types = {c.name: carry(c.name, NO_CLASSES) for c in model.classes}
        self._used_types = set(self.class_types.values()) | RUNTIME_CLASSES
        self._headers = {header_stem(t) for t in RUNTIME_CLASSES}
        self._keys = self._named_keys()
        self._topics = {root: self._topic(root) for root in self._roots()}
        self.states = {c.name: self._state(analysis.classes[c.name]) for c in model.classes}

    @property
    def messages(self) -> tuple[MessageType, ...]:
        """All message types, in the order in which the model declares their servers."""
        return tuple(self._topics[root].message for root in self._roots())

    def of(self, class_name: str, wanted: Signature) -> ServerTopic:
        """The topic of a server as a class declares or inherits it."""
        return self._topics[self._find(self._declaring(class_name, wanted))]

    def called(self, server: ServerSymbol) -> ServerTopic:
        """The topic of a server that a call refers to."""
        declaration = server.declaration
        return self.of(server.owner, signature(server.name, declaration.parameters))

    def subscriber(self, class_name: str, wanted: Signature) -> str:
        """The reactive class in the lineage that makes the subscription: the topmost to have it."""
        lineage = self._analysis.classes[class_name].lineage
        for name in reversed(lineage):
            info = self._analysis.classes[name]
            if not info.is_interface and wanted in self._signatures[name]:
                return name
        return class_name

    # --- families -------------------------------------------------------------------------------

    def _unite(self, model: Model) -> dict[tuple[str, Signature], tuple[str, Signature]]:
        families = {place: place for place in self._declared}
        self._families = families
        for c in model.classes:
            lineage = self._analysis.classes[c.name].lineage
            for wanted in self._signatures[c.name]:
                places = [(n, wanted) for n in lineage if (n, wanted) in self._declared]
                for other in places[1:]:
                    first, second = self._find(places[0]), self._find(other)
                    earlier, later = sorted((first, second), key=self._place_order)
                    families[later] = earlier
        return families

    def _place_order(self, place: tuple[str, Signature]) -> int:
        return self._order[place[0]]

    def _find(self, place: tuple[str, Signature]) -> tuple[str, Signature]:
        while self._families[place] != place:
            place = self._families[place]
        return place

    def _declaring(self, class_name: str, wanted: Signature) -> tuple[str, Signature]:
        for name in self._analysis.classes[class_name].lineage:
            if (name, wanted) in self._declared:
                return name, wanted
        raise KeyError((class_name, wanted))

    def _roots(self) -> list[tuple[str, Signature]]:
        return [place for place in self._declared if self._find(place) == place]

    def _family(self, root: tuple[str, Signature]) -> list[MessageServer]:
        return [s for place, s in self._declared.items() if self._find(place) == root]

    # --- what a family is called ----------------------------------------------------------------

    def _topic(self, root: tuple[str, Signature]) -> ServerTopic:
        class_name, (name, _) = root
        parameters = self._declared[root].parameters
        key = self._keys[root]
        family = self._family(root)
        message = MessageType(
            self._new_type(message_name(class_name, key)),
            message_fields(parameters, (*RUNTIME_FIELDS, RESPONSE_FIELD)),
            any(map(self._uses_sender, family)),
            f"{class_name}.{name}",
        )
        annotated = {a.name for s in family for a in s.annotations}
        offer = self._offered_type(message, annotated)
        return ServerTopic(class_name, name, key, parameters, message, "Port" in annotated, offer)

    def _offered_type(self, message: MessageType, annotated: set[str]) -> str | None:
        """The type of a service or an action; ROS 1 has messages of its own for an action."""
        if "Service" in annotated:
            return self._new_type(f"{message.name}Call")
        if "Action" not in annotated:
            return None
        offer = self._new_type(f"{message.name}Task")
        parts = ("Goal", "Result", "Feedback")
        own = ("Action", *parts, *(f"Action{part}" for part in parts))
        self._used_types |= {f"{offer}{part}" for part in own}
        self._headers |= {header_stem(f"{offer}{part}") for part in own}
        return offer

    def _new_type(self, name: str) -> str:
        """The name of a message type: no other has it, nor one whose header is called the same."""
        candidate, number = unique(name, self._used_types, ""), 2
        while header_stem(candidate) in self._headers:
            candidate, number = unique(f"{name}{number}", self._used_types, ""), number + 1
        self._headers.add(header_stem(candidate))
        return candidate

    def _named_keys(self) -> dict[tuple[str, Signature], str]:
        """The last segment of each family's topic; no class has two of one name."""
        keys: dict[tuple[str, Signature], str] = {}
        classes = {root: self._classes_of(root) for root in self._roots()}
        for root in sorted(classes, key=self._is_overloaded):
            name, types = root[1]
            key = free_name(name, RUNTIME_TOPICS)
            if self._is_overloaded(root):
                words = (graph_name(t.partition("[")[0]) + _lengths(t) for t in types)
                key = f"{key}_{'_'.join(words) or 'void'}"
            keys[root] = unique(key, {k for r, k in keys.items() if classes[root] & classes[r]})
        return keys

    def _classes_of(self, root: tuple[str, Signature]) -> frozenset[str]:
        """The classes that have a server of a family."""
        wanted = root[1]
        return frozenset(
            name
            for name in self._order
            if wanted in self._signatures[name]
            and self._find(self._declaring(name, wanted)) == root
        )

    def _is_overloaded(self, root: tuple[str, Signature]) -> bool:
        """Whether some class has another server of the same name beside one of this family."""
        name = root[1][0]
        for class_name, info in self._analysis.classes.items():
            same = [s for s in self._signatures[class_name] if s[0] == name]
            places = ((n, root[1]) for n in info.lineage if (n, root[1]) in self._declared)
            if len(same) > 1 and any(self._find(place) == root for place in places):
                return True
        return False

    def _uses_sender(self, server: MessageServer) -> bool:
        if server.body is None:
            return False
        symbols: Mapping[int, object] = self._analysis.symbols
        return any(
            isinstance(node, Name)
            and node.name == "sender"
            and isinstance(symbols.get(id(node)), BuiltinSymbol)
            for node in walk(server.body)
        )

    def _state(self, info: ClassInfo) -> StateType:
        variables = [(s.name, s.type or Type("int")) for s in info.state]
        fields = field_names([name for name, _ in variables], STATE_FIELDS)
        return StateType(
            self._new_type(f"{camel_case(info.name)}State"),
            tuple(Field(f, t, n) for f, (n, t) in zip(fields, variables, strict=True)),
        )


def _lengths(type_: str) -> str:
    """The lengths of an array, `_2_3`, for a topic's name."""
    return "".join(f"_{length}" for length in re.findall(r"\[(\d+)\]", type_))


def message_fields(parameters: tuple[Parameter, ...], taken: tuple[str, ...]) -> tuple[Field, ...]:
    """One field a parameter, in their order."""
    names = field_names([p.name for p in parameters], taken)
    return tuple(Field(n, p.type, p.name) for n, p in zip(names, parameters, strict=True))
