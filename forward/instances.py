"""The rebecs of `main` as ROS nodes: their parameters, and what their private names stand for."""

from __future__ import annotations

from rebsync.forward.topics import Topics
from rebsync.model import Expression, Model, Name, Rebec, Type
from rebsync.names import graph_name, node_name, unique
from rebsync.package import Instance, NodeClass, NodeParameter, Publisher, Remap, StandIn, Value
from rebsync.static import Analysis
from rebsync.static.constants import constant
from rebsync.static.symbols import EnvSymbol, RebecSymbol
from rebsync.static.values import converted


class Instances:
    """The nodes of a package, as the launch file starts them."""

    def __init__(
        self, model: Model, analysis: Analysis, topics: Topics, classes: tuple[NodeClass, ...]
    ) -> None:
        self._analysis = analysis
        self._topics = topics
        self._classes = {c.name: c for c in classes}
        self._rebecs = model.main.rebecs if model.main is not None else ()
        self._class_of = {r.name: r.type.name for r in self._rebecs}

    def instances(self) -> tuple[Instance, ...]:
        """One node a rebec, in the order of `main`."""
        return tuple(
            Instance(
                node_name(r.name),
                r.name,
                r.type.name,
                (*self._known_parameters(r), *self._arguments(r)),
                tuple(self._remaps(r)),
                r.annotations,
            )
            for r in self._rebecs
        )

    def stand_ins(self) -> tuple[StandIn, ...]:
        """A node that plays the sensors for each rebec whose sensors are not bound."""
        used = {node_name(r.name) for r in self._rebecs}
        found = []
        for rebec in self._rebecs:
            node = node_name(rebec.name)
            for name in self._lineage(rebec):
                sensors = [s for s in self._classes[name].sensors if s.stands_in]
                if sensors:
                    remaps = tuple(Remap(f"~{s.name}", f"{node}/sensor/{s.name}") for s in sensors)
                    found.append(StandIn(unique(f"{node}_stand_in", used), name, remaps))
        return tuple(found)

    def instances_of(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """The rebecs of every class that a variable or a test for a type may mean."""
        return tuple(
            (graph_name(c), names)
            for c in self._classes
            if (names := tuple(node_name(r) for r in self._of_class(c)))
        )

    def _of_class(self, class_name: str) -> list[str]:
        return [
            rebec
            for rebec, own in self._class_of.items()
            if class_name in self._analysis.classes[own].lineage
        ]

    def _lineage(self, rebec: Rebec) -> tuple[str, ...]:
        return self._analysis.classes[rebec.type.name].lineage

    # --- parameters -----------------------------------------------------------------------------

    def _bindings(self, rebec: Rebec) -> dict[str, str]:
        known = self._analysis.classes[rebec.type.name].known
        bound = {}
        for symbol, binding in zip(known, rebec.bindings, strict=False):
            name = self._rebec_name(binding)
            if name is not None:
                bound[symbol.name] = name
        return bound

    def _rebec_name(self, expression: Expression) -> str | None:
        symbol = self._analysis.symbols.get(id(expression))
        return symbol.name if isinstance(symbol, RebecSymbol) else None

    def _known_parameters(self, rebec: Rebec) -> list[NodeParameter]:
        known = {s.name: s.type for s in self._analysis.classes[rebec.type.name].known}
        return [
            NodeParameter(f"knownrebecs/{graph_name(name)}", type_, node_name(bound))
            for name, bound in self._bindings(rebec).items()
            if (type_ := known[name]) is not None
        ]

    def _arguments(self, rebec: Rebec) -> list[NodeParameter]:
        constructor = self._analysis.constructor_of(rebec)
        parameters = constructor.parameters if constructor is not None else ()
        return [
            NodeParameter(
                graph_name(parameter.name),
                parameter.type,
                self._argument(argument, parameter.type.name),
            )
            for parameter, argument in zip(parameters, rebec.arguments, strict=True)
        ]

    def _argument(self, argument: Expression, type_name: str) -> Value:
        rebec = self._rebec_name(argument)
        if rebec is not None:
            return node_name(rebec)
        value = constant(argument, self._env_value)
        if value is None:
            return ""
        return converted(value, Type(type_name))

    def _env_value(self, name: Name) -> int | float | bool | None:
        symbol = self._analysis.symbols.get(id(name))
        return symbol.value if isinstance(symbol, EnvSymbol) else None

    # --- remaps ---------------------------------------------------------------------------------

    def _remaps(self, rebec: Rebec) -> list[Remap]:
        bound = self._bindings(rebec)
        remaps: list[Remap] = []
        for class_name in reversed(self._lineage(rebec)):
            node_class = self._classes[class_name]
            for publisher in node_class.publishers:
                remaps += self._publisher_remaps(publisher, bound)
            for sensor in node_class.sensors:
                if sensor.topic is not None:
                    remaps.append(Remap(f"~sensor/{sensor.name}", sensor.topic))
        return remaps

    def _publisher_remaps(self, publisher: Publisher, bound: dict[str, str]) -> list[Remap]:
        if publisher.known is not None:
            receiver = bound.get(publisher.known)
            if receiver is None:
                return []
            return [Remap(f"~{publisher.topic}", self.topic(receiver, publisher))]
        return [
            Remap(
                f"~{publisher.topic}/{node_name(receiver)}/{publisher.key}",
                self.topic(receiver, publisher),
            )
            for receiver in self._of_class(publisher.target)
        ]

    def topic(self, receiver: str, publisher: Publisher) -> str:
        """The topic on which a rebec takes a server's messages."""
        class_name = self._class_of[receiver]
        types = tuple(str(p.type) for p in publisher.parameters)
        wanted = (publisher.server, types)
        topic = self._topics.of(class_name, wanted)
        subscriber = self._topics.subscriber(class_name, wanted)
        bridge = self._analysis.classes[subscriber].annotated("Controller")
        segments = ["control_bridge"] if bridge else []
        segments += [node_name(receiver), *(["port"] if topic.port else []), topic.key]
        return "/".join(segments)
