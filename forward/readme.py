"""The README of a package."""

from __future__ import annotations

from rebsync.forward.templating import fill
from rebsync.package import Instance, NodeClass, Package
from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class _Picture:
    nodes: tuple[tuple[str, str], ...]
    edges: tuple[tuple[str, str, str], ...]


@dataclass(frozen=True, slots=True)
class _Row:
    topic: str
    type: str
    receiver: str
    senders: str


def readme(package: Package, model_name: str, templates: str, sensors: str) -> str:
    """The package's README with a picture of its nodes and topics.

    `templates` is the folder of the dialect, `sensors` the pattern of the files that say what
    sensors have seen.
    """
    found = _rows(package)
    edges = {
        (sender, row.receiver, row.topic.rpartition("/")[2]): None
        for row in found
        for sender in row.senders.split(", ")
        if sender
    }
    nodes = tuple((i.name, i.class_name) for i in package.instances)
    return fill(
        f"{templates}/README.md.j2",
        package=package,
        model_name=model_name,
        picture=_Picture(nodes, tuple(edges)),
        rows=found,
        sensors=_sensor_lines(package, sensors),
    )


def _rows(package: Package) -> list[_Row]:
    senders: dict[str, list[str]] = {}
    for instance in package.instances:
        for remap in instance.remaps:
            senders.setdefault(remap.target, []).append(instance.name)
    rows = []
    for instance in package.instances:
        for node in _lineage(package, instance.class_name):
            for server in node.subscriptions:
                if not server.inherited:
                    prefix = "control_bridge/" if server.on_bridge else ""
                    topic = f"{prefix}{instance.name}/{server.topic}"
                    sent = [*senders.get(topic, []), *_self(package, instance, server.key)]
                    names = ", ".join(dict.fromkeys(sent))
                    rows.append(_Row(f"/{topic}", server.message.name, instance.name, names))
    return rows


def _self(package: Package, instance: Instance, key: str) -> list[str]:
    lineage = _lineage(package, instance.class_name)
    return [instance.name] if any(s.key == key for n in lineage for s in n.self_sends) else []


def _lineage(package: Package, name: str) -> list[NodeClass]:
    node = package.node_class(name)
    found = [node]
    for base in node.bases:
        if not package.node_class(base).interface:
            found += _lineage(package, base)
    return found


def _sensor_lines(package: Package, sensors: str) -> list[str]:
    lines = []
    for node in package.classes:
        for sensor in node.sensors:
            what = f"`{node.name}.{sensor.server}` samples `<node>/sensor/{sensor.name}`"
            if sensor.stands_in:
                lines.append(
                    f"* {what}, which a stand-in fills with random data. To bind a sensor, give "
                    "its topic and type in `rebsync.toml` under "
                    f'`[sensors."{node.name}.{sensor.server}"]`.'
                )
            else:
                file = sensors.format(package=package.name, file=node.file)
                lines.append(
                    f"* {what}, which the launch file maps to `{sensor.topic}` ({sensor.type}); "
                    f"`{file}` says what it has seen."
                )
    return lines
