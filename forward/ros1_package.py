"""What surrounds the code of a ROS 1 package: manifest, build file, launch file, parameters."""

from __future__ import annotations

from math import prod

from rebsync.forward.templating import fill
from rebsync.model import Type
from rebsync.package import Instance, NodeClass, NodeParameter, Package, Remap, Value
from rebsync.printing import print_line
from rebsync.records import dataclass

_TYPES = {
    "byte": "int8",
    "short": "int16",
    "int": "int32",
    "float": "float32",
    "double": "float64",
    "boolean": "bool",
}
_PARAMETER_TYPES = {"byte": "int", "short": "int", "int": "int", "boolean": "bool"}

_YAML_WORDS = frozenset({"false", "n", "no", "null", "off", "on", "true", "y", "yes"})


def ros1_type(type_: Type) -> str:
    """The type of a message field; arrays of several dimensions are flattened."""
    element = _TYPES.get(type_.name, "string")
    return f"{element}[{prod(type_.dimensions)}]" if type_.dimensions else element


# --- package.xml and CMakeLists.txt -------------------------------------------------------------


def _depends(package: Package) -> list[str]:
    found = {"roscpp", "std_msgs"}
    if any(c.moves for c in package.classes):
        found.add("geometry_msgs")
    for node in package.classes:
        found |= {s.type.partition("/")[0] for s in node.sensors if "/" in s.type}
    return sorted(found - {package.name})


def manifest(package: Package) -> str:
    """package.xml, format 2."""
    return fill("ros1_cpp/package.xml.j2", package=package, depends=_depends(package))


@dataclass(frozen=True, slots=True)
class _Executable:
    name: str
    sources: tuple[str, ...]


def cmake_lists(package: Package) -> str:
    """CMakeLists.txt for catkin."""
    depends = _depends(package)
    messages = {"Timing"} | {m.name for m in package.messages}
    messages |= {c.state.name for c in package.classes if c.executable}
    messages |= {s.type for c in package.classes for s in c.sensors if s.stands_in}
    return fill(
        "ros1_cpp/CMakeLists.txt.j2",
        package=package.name,
        build_depends=sorted([*depends, "message_generation"]),
        run_depends=sorted([*depends, "message_runtime"]),
        messages=sorted(messages),
        executables=_executables(package),
    )


def _executables(package: Package) -> list[_Executable]:
    found = []
    for node in package.classes:
        if node.executable:
            sources = [f"{node.file}_node", node.file, *_base_sources(package, node)]
            found.append(_Executable(f"{node.file}_node", tuple(sorted(sources))))
        if any(s.stands_in for s in node.sensors):
            found.append(_Executable(f"{node.file}_stand_in", (f"{node.file}_stand_in",)))
    return sorted(found, key=lambda e: e.name)


def _base_sources(package: Package, node: NodeClass) -> list[str]:
    found = []
    for base in map(package.node_class, node.bases):
        if not base.interface:
            found += [base.file, *_base_sources(package, base)]
    return found


# --- launch file and parameters -----------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Node:
    name: str
    executable: str
    markers: tuple[str, ...]
    parameters: tuple[tuple[str, str, str], ...]
    remaps: tuple[Remap, ...]


def launch_file(package: Package) -> str:
    """One node a rebec, and one for each rebec whose sensors a stand-in plays."""
    nodes = [_instance(package, i) for i in package.instances]
    nodes += [
        _Node(
            s.name,
            f"{package.node_class(s.class_name).file}_stand_in",
            (f"stand-in {s.name}",),
            (),
            s.remaps,
        )
        for s in package.stand_ins
    ]
    needed = {p.target for c in package.classes for p in c.publishers if p.known is None}
    return fill(
        "ros1_cpp/package.launch.j2",
        package=package,
        nodes=nodes,
        rebecs=[yaml_name(i.name) for i in package.instances],
        instances_of=[
            (yaml_name(name), [yaml_name(r) for r in rebecs])
            for name, rebecs in package.instances_of
            if needed or _tests_types(package)
        ],
    )


def _tests_types(package: Package) -> bool:
    return any(c.tests_types for c in package.classes)


def _instance(package: Package, instance: Instance) -> _Node:
    annotations = (
        f"annotation {print_line(a).strip()}".replace("--", "-&#45;") for a in instance.annotations
    )
    return _Node(
        instance.name,
        f"{package.node_class(instance.class_name).file}_node",
        (*annotations, f"rebec {instance.rebec}"),
        tuple(_parameter(p) for p in instance.parameters),
        instance.remaps,
    )


def _parameter(parameter: NodeParameter) -> tuple[str, str, str]:
    kind = _PARAMETER_TYPES.get(parameter.type.name)
    if kind is None:
        kind = "double" if parameter.type.name in _TYPES else "str"
    return parameter.key, yaml_value(parameter.value), kind


def yaml_value(value: Value) -> str:
    """A constant in YAML."""
    match value:
        case bool():
            return "true" if value else "false"
        case tuple():
            return f"[{', '.join(yaml_value(v) for v in value)}]"
        case float():
            text = repr(value)  # 1e-07 would be text in YAML 1.1
            return text if "." in text or "e" not in text else text.replace("e", ".0e")
        case _:
            return str(value)


def yaml_name(name: str) -> str:
    """A name in YAML: in quotes where it would be a truth value."""
    return f'"{name}"' if name.lower() in _YAML_WORDS else name


def parameters(package: Package) -> str:
    """config/params.yaml."""
    used = {e.name for c in package.classes for e in c.env}
    # No class tells the type of what it does not read.
    types = {e.name: f"  # rebsync: env {e.type} {e.name}" for e in package.env}
    return fill(
        "ros1_cpp/params.yaml.j2",
        env=[
            (yaml_name(e.key), yaml_value(e.value) + ("" if e.name in used else types[e.name]))
            for e in package.env
        ],
        settings=package.settings,
        moves=any(c.moves for c in package.classes),
    )


# --- README -------------------------------------------------------------------------------------


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


def readme(package: Package, model_name: str) -> str:
    """The package's README with a picture of its nodes and topics."""
    rows = _rows(package)
    edges = {
        (sender, row.receiver, row.topic.rpartition("/")[2]): None
        for row in rows
        for sender in row.senders.split(", ")
        if sender
    }
    nodes = tuple((i.name, i.class_name) for i in package.instances)
    return fill(
        "ros1_cpp/README.md.j2",
        package=package,
        model_name=model_name,
        picture=_Picture(nodes, tuple(edges)),
        rows=rows,
        sensors=_sensor_lines(package),
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


def _sensor_lines(package: Package) -> list[str]:
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
                lines.append(
                    f"* {what}, which the launch file maps to `{sensor.topic}` ({sensor.type}); "
                    f"`include/{package.name}/{node.file}_sensors.h` says what it has seen."
                )
    return lines
