"""Names of topics and services that two parts of a system would share.

An action of ROS 1 has five topics of its own, the node has services of its own, a sensor has
whatever topic the settings say, and what a launch file remaps for one name it remaps for all.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.config import Config
from rebsync.diagnostics import Diagnostic
from rebsync.forward.topics import declared_servers
from rebsync.forward.view import view
from rebsync.model import Model
from rebsync.package import Instance, NodeClass, Package, Sensor, Subscription
from rebsync.records import dataclass
from rebsync.source import NOWHERE, Span
from rebsync.static import Analysis

_OF_ACTION = ("goal", "cancel", "status", "feedback", "result")
_OF_NODE = {
    "ros1": ("get_loggers", "set_logger_level"),
    "ros2": (
        *("describe_parameters", "get_logger_levels", "get_parameter_types", "get_parameters"),
        *("get_type_description", "list_parameters", "set_logger_levels", "set_parameters"),
        "set_parameters_atomically",
    ),
    "lifecycle": (
        *("change_state", "get_available_states", "get_available_transitions", "get_state"),
        "get_transition_graph",
    ),
}
_HINT = "call one of them otherwise, in the model or in rebsync.toml"


@dataclass(frozen=True, slots=True)
class _Use:
    """Who has a name: a topic or a service. What carries the same `type` may share it."""

    kind: str
    name: str
    who: str
    span: Span = NOWHERE
    type: str | None = None


def clashes(model: Model, analysis: Analysis, config: Config, name: str) -> list[Diagnostic]:
    """Each name that means two things; the model must be one that a package can be made of."""
    package, _ = view(model, analysis, config, name)
    first: dict[tuple[str, str], _Use] = {}
    found: dict[tuple[Span, str], Diagnostic] = {}
    for use in _uses(package, model, config):
        other = first.setdefault((use.kind, use.name), use)
        if other is use or (use.type is not None and use.type == other.type):
            continue
        span = use.span if use.span != NOWHERE else other.span
        message = f'{other.who} and {use.who} would be one {use.kind}, "/{use.name}"'
        found.setdefault((span, use.name), Diagnostic("RS712", span, message, _HINT))
    return list(found.values())


def _uses(package: Package, model: Model, config: Config) -> Iterator[_Use]:
    spans = {f"{c.name}.{s.name}": s.span for c in model.classes for s in declared_servers(c)}
    yield _Use("topic", "startup", "the start of all nodes")
    yield _Use("topic", "diagnostics", "the diagnostics of all nodes")
    for instance in package.instances:
        ros = config.target_of(instance.class_name)[:4]
        yield from _of_node(package, instance, config, ros)
        for node_class in _lineage(package, instance.class_name):
            for served in node_class.subscriptions:
                if not (served.inherited or node_class.interface):
                    yield from _of_server(instance, served, ros, spans.get(served.path, NOWHERE))
            for sensor in node_class.sensors:
                yield _of_sensor(instance, sensor)


def _lineage(package: Package, class_name: str) -> list[NodeClass]:
    """A class and all that it descends from, each once."""
    found: dict[str, NodeClass] = {}
    waiting = [class_name]
    while waiting:
        node_class = package.node_class(waiting.pop())
        found[node_class.name] = node_class
        waiting += [base for base in node_class.bases if base not in found]
    return list(found.values())


def _of_node(package: Package, instance: Instance, config: Config, ros: str) -> Iterator[_Use]:
    """What a node has whatever its model says, and what its launch file remaps."""
    name = instance.name
    yield _Use("topic", f"{name}/state", f'the state of "{name}"')
    if any(c.moves or c.robot for c in _lineage(package, instance.class_name)):
        yield _Use("topic", f"{name}/cmd_vel", f'the velocity of "{name}"')
        if config.odometry is not None:
            yield _Use("topic", f"{name}/drive/difference", f'the odometry of "{name}"')
            odometry = _absolute(config.odometry, name)
            yield _Use("topic", odometry, f'the odometry of "{name}"', type="nav_msgs/Odometry")
    services = _OF_NODE[ros]
    if ros == "ros2" and config.lifecycle:
        services += _OF_NODE["lifecycle"]
    for service in services:
        yield _Use("service", f"{name}/{service}", f'a service that each node has, of "{name}",')
    for remap in instance.remaps:
        if not remap.private.startswith("~sensor/"):
            private = f"{name}/{remap.private.removeprefix('~')}"
            yield _Use("topic", private, f'what "{name}" sends to "{remap.target}"')


def _of_server(instance: Instance, served: Subscription, ros: str, span: Span) -> Iterator[_Use]:
    prefix = "control_bridge/" if served.on_bridge else ""
    topic, who = (
        f"{prefix}{instance.name}/{served.topic}",
        f'"{served.server}" of "{instance.name}"',
    )
    yield _Use("topic", topic, who, span)
    if served.offer is None:
        return
    if not served.offer.is_action:
        yield _Use("service", topic, f"the service {who}", span)
    elif ros == "ros1":
        for part in _OF_ACTION:
            yield _Use("topic", f"{topic}/{part}", f"the {part} of the action {who}", span)


def _of_sensor(instance: Instance, sensor: Sensor) -> _Use:
    topic = sensor.topic if sensor.topic is not None else f"~sensor/{sensor.name}"
    who = f'the sensor "{sensor.server}" of "{instance.name}"'
    return _Use("topic", _absolute(topic, instance.name), who, type=sensor.type)


def _absolute(topic: str, node: str) -> str:
    """A topic from the root, without the slash."""
    if topic.startswith("~"):
        return f"{node}/{topic.removeprefix('~').removeprefix('/')}"
    return topic.removeprefix("/")
