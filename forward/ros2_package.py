"""What surrounds the code of a ROS 2 package: manifest, build file, launch file, parameters."""

from __future__ import annotations

from rebsync.forward.cpp_class import CppClass
from rebsync.forward.headers import unchecked
from rebsync.forward.message_files import action_names, message_names, service_names
from rebsync.forward.ros2_constructors import component
from rebsync.forward.runtime_part import message_packages, odometry_topic
from rebsync.forward.templating import fill
from rebsync.forward.yaml_values import is_yaml_word, yaml_name, yaml_value
from rebsync.package import Instance, Package, Remap, StandIn, Value
from rebsync.printing import print_line
from rebsync.records import dataclass

_LINE_LENGTH = 100


def _message_packages(package: Package) -> list[str]:
    return sorted({"rcl_interfaces"} | message_packages(package))


def _depends(package: Package) -> list[str]:
    found = [*_message_packages(package), "rclcpp", "rclcpp_components"]
    found += ["rclcpp_action"] if package.actions else []
    found += ["rclcpp_lifecycle"] if package.settings.lifecycle else []
    return sorted(found)


def manifest(package: Package) -> str:
    """package.xml, format 3."""
    return fill("ros2_cpp/package.xml.j2", package=package, depends=_depends(package))


def cmake_lists(package: Package, classes: list[CppClass]) -> str:
    """CMakeLists.txt for ament: the classes are one library, which each executable runs one of."""
    runs = [c for c in classes if c.node.executable]
    return fill(
        "ros2_cpp/CMakeLists.txt.j2",
        package=package.name,
        depends=_depends(package),
        message_packages=_message_packages(package),
        messages=message_names(package),
        services=service_names(package),
        actions=action_names(package),
        sources=sorted(c.node.file for c in classes if not c.node.interface),
        components=sorted(map(component, runs)),
        executables=package.executables,
        lifecycle=package.settings.lifecycle,
        unchecked=unchecked(package),
    )


# --- launch file --------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Node:
    name: str
    executable: str
    markers: tuple[str, ...]
    takes_part: bool
    parameters: tuple[tuple[str, str], ...]
    remaps: tuple[Remap, ...]


def launch_file(package: Package) -> str:
    """One node a rebec, and one for each rebec whose sensors a stand-in plays."""
    nodes = [_instance(package, i) for i in package.instances]
    nodes += [_stand_in(package, s) for s in package.stand_ins]
    system = _system(package)
    values = [value for _, value in system] + [v for n in nodes for _, v in n.parameters]
    return fill(
        "ros2_cpp/package.launch.py.j2",
        package=package,
        nodes=nodes,
        system=system,
        lifecycle=package.settings.lifecycle,
        typed=any("ParameterValue(" in value for value in values),
    )


def _system(package: Package) -> list[tuple[str, str]]:
    """The parameters that all rebecs have."""
    if not package.instances:
        return []
    found = [("mailbox.rebecs", _python_list([i.name for i in package.instances], 8))]
    chosen = {p.target for c in package.classes for p in c.publishers if p.known is None}
    if chosen or any(c.tests_types for c in package.classes):
        found += [
            (f"mailbox.instances.{name}", _python_list(rebecs, 8))
            for name, rebecs in package.instances_of
        ]
    return found


def _instance(package: Package, instance: Instance) -> _Node:
    annotations = (f"annotation {print_line(a).strip()}" for a in instance.annotations)
    return _Node(
        instance.name,
        f"{package.node_class(instance.class_name).file}_node",
        (*annotations, f"rebec {instance.rebec}"),
        True,
        tuple((p.key.replace("/", "."), _python(p.value)) for p in instance.parameters),
        tuple(map(_private, instance.remaps)),
    )


def _stand_in(package: Package, stand_in: StandIn) -> _Node:
    return _Node(
        stand_in.name,
        f"{package.node_class(stand_in.class_name).file}_stand_in",
        (f"stand-in {stand_in.name}",),
        False,
        (),
        tuple(map(_private, stand_in.remaps)),
    )


def _private(remap: Remap) -> Remap:
    """Private names have a slash behind the tilde in ROS 2."""
    return Remap(remap.private.replace("~", "~/"), remap.target)


def _python(value: Value) -> str:
    """A constant in Python; a launch file would take some names for truth values."""
    if not isinstance(value, str):
        return repr(value)
    return f'ParameterValue("{value}", value_type=str)' if is_yaml_word(value) else f'"{value}"'


def _python_list(names: list[str] | tuple[str, ...], indent: int) -> str:
    """A list of names, on lines of its own where one is too long."""
    texts = [f'"{name}"' for name in names]
    typed = any(is_yaml_word(name) for name in names)
    before, after = ("ParameterValue(", ", value_type=list[str])") if typed else ("", "")
    line = f"{before}[{', '.join(texts)}]{after}"
    if indent + len(line) <= _LINE_LENGTH - 40:
        return line
    edge = "\n" + " " * (indent + 4 * typed)
    inner = f"[{''.join(f'{edge}    {text},' for text in texts)}{edge}]"
    last = "\n" + " " * indent
    return f"{before}{edge}{inner},{edge}value_type=list[str],{last})" if typed else inner


# --- parameters ---------------------------------------------------------------------------------


def parameters(package: Package) -> str:
    """config/params.yaml."""
    used = {e.name for c in package.classes for e in c.env}
    # No class tells the type of what it does not read.
    types = {e.name: f"  # rebsync: env {e.type} {e.name}" for e in package.env}
    return fill(
        "ros2_cpp/params.yaml.j2",
        env=[
            (
                yaml_name(e.key),
                yaml_value(_flat(e.value)) + ("" if e.name in used else types[e.name]),
            )
            for e in package.env
        ],
        settings=package.settings,
        services=package.services,
        odometry=odometry_topic(package, is_ros2=True),
        moves=any(c.moves for c in package.classes),
    )


def _flat(value: Value) -> Value:
    """Arrays of several dimensions, one value after the other: parameters have but one."""
    if not isinstance(value, tuple):
        return value
    found: list[Value] = []
    for item in map(_flat, value):
        found += item if isinstance(item, tuple) else [item]
    return tuple(found)
