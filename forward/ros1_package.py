"""What surrounds the code of a ROS 1 package: manifest, build file, launch file, parameters."""

from __future__ import annotations

from rebsync.forward.message_files import (
    FIELD_TYPES,
    action_names,
    message_names,
    service_names,
)
from rebsync.forward.runtime_part import action_packages, message_packages, odometry_topic
from rebsync.forward.templating import fill
from rebsync.forward.yaml_values import yaml_name, yaml_value
from rebsync.package import Instance, NodeParameter, Package, Remap
from rebsync.printing import print_line
from rebsync.records import dataclass

_PARAMETER_TYPES = {"byte": "int", "short": "int", "int": "int", "boolean": "bool"}


# --- package.xml and CMakeLists.txt -------------------------------------------------------------


def depends_of(package: Package) -> list[str]:
    """The packages that the nodes need."""
    return sorted({"roscpp"} | message_packages(package) | action_packages(package))


def manifest(package: Package) -> str:
    """package.xml, format 2."""
    return fill("ros1_cpp/package.xml.j2", package=package, depends=depends_of(package))


def cmake_lists(package: Package) -> str:
    """CMakeLists.txt for catkin."""
    depends = depends_of(package)
    return fill(
        "ros1_cpp/CMakeLists.txt.j2",
        package=package.name,
        build_depends=sorted([*depends, "message_generation"]),
        run_depends=sorted([*depends, "message_runtime"]),
        messages=message_names(package),
        services=service_names(package),
        actions=action_names(package),
        library=library_of(package),
        executables=package.executables,
    )


def library_of(package: Package) -> list[str]:
    """The sources of the classes, which are one library."""
    return sorted(n.file for n in package.classes if not n.interface)


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
        kind = "double" if parameter.type.name in FIELD_TYPES else "str"
    return parameter.key, yaml_value(parameter.value), kind


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
        services=package.services,
        odometry=odometry_topic(package, is_ros2=False),
        moves=any(c.moves for c in package.classes),
    )
