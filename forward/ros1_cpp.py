"""ROS 1 C++ (roscpp, Noetic): a package value as the files of a catkin package."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.forward.cpp_class import CppClass
from rebsync.forward.cpp_expressions import CppExpressions
from rebsync.forward.cpp_names import CppNames, class_names
from rebsync.forward.cpp_statements import CppStatements
from rebsync.forward.cpp_types import cpp_type, cpp_value
from rebsync.forward.effects import hoisted, read_declarations
from rebsync.forward.remarks import Remarks
from rebsync.forward.ros1_class import header, sensor_header, source
from rebsync.forward.ros1_constructors import node_main
from rebsync.forward.ros1_package import (
    cmake_lists,
    launch_file,
    manifest,
    parameters,
    readme,
    ros1_type,
)
from rebsync.forward.sends import bodies
from rebsync.forward.sensors import draws_of
from rebsync.forward.templating import fill
from rebsync.forward.topics import Topics
from rebsync.model import MessageServer, ReactiveClass
from rebsync.package import Field, NodeClass, Package
from rebsync.static import Analysis

TIMING = ("int64 arrival", "int64 deadline")
STATE_HEAD = (
    "string server",
    "string arguments",
    "int64 arrival",
    "int64 start",
    "int64 now",
)


def render(
    package: Package, analysis: Analysis, topics: Topics, remarks: Remarks, model_name: str
) -> dict[str, str]:
    """The files of the package by path, relative to its folder."""
    files: dict[str, str] = {
        "package.xml": manifest(package),
        "CMakeLists.txt": cmake_lists(package),
        ".clang-format": fill("ros1_cpp/clang-format.j2"),
        "README.md": readme(package, model_name),
        f"launch/{package.name}.launch": launch_file(package),
        "config/params.yaml": parameters(package),
    }
    files.update(_messages(package))
    files.update(_runtime(package))
    for c in _classes(package, analysis, topics, remarks).values():
        include = f"include/{package.name}/{c.node.file}"
        files[f"{include}.h"] = header(c, model_name)
        if c.node.interface:
            continue
        files[f"src/{c.node.file}.cpp"] = source(c)
        if c.node.executable:
            files[f"src/{c.node.file}_node.cpp"] = node_main(c)
        if any(s.draws for s in c.node.sensors):
            files[f"{include}_sensors.h"] = sensor_header(c)
        if any(s.stands_in for s in c.node.sensors):
            files[f"src/{c.node.file}_stand_in.cpp"] = _stand_in(package, c.node)
    return dict(sorted(files.items()))


def _runtime(package: Package) -> dict[str, str]:
    names = ["mailbox", "startup", "values"]
    if any(c.moves for c in package.classes):
        names.append("drive")
    if any(c.sensors for c in package.classes):
        names.append("sensor")
    return {
        f"include/{package.name}/{n}.h": fill(f"ros1_cpp/{n}.h.j2", package=package.name)
        for n in names
    }


def _messages(package: Package) -> dict[str, str]:
    files = {"msg/Timing.msg": _message(TIMING)}
    for message in package.messages:
        sender = ["string sender"] if message.carries_sender else []
        lines = [f"{package.name}/Timing timing", *sender, *map(_field, message.fields)]
        files[f"msg/{message.name}.msg"] = _message(lines)
    for node in package.classes:
        if node.executable:
            lines = [*STATE_HEAD, *map(_field, node.state.fields)]
            files[f"msg/{node.state.name}.msg"] = _message(lines)
        for sensor in node.sensors:
            if sensor.stands_in:
                lines = [f"{ros1_type(d.type)} {d.field}" for d in sensor.draws]
                files[f"msg/{sensor.type}.msg"] = _message(lines)
    return files


def _message(lines: list[str] | tuple[str, ...]) -> str:
    return fill("ros1_cpp/message.msg.j2", lines=list(lines))


def _field(field: Field) -> str:
    return f"{ros1_type(field.type)} {field.name}"


def _classes(
    package: Package, analysis: Analysis, topics: Topics, remarks: Remarks
) -> Mapping[str, CppClass]:
    names = class_names(package, topics.class_types)
    found: dict[str, CppClass] = {}
    for node in package.classes:
        declaration = analysis.classes[node.name].declaration
        reactive = declaration if isinstance(declaration, ReactiveClass) else None
        expressions = CppExpressions(
            analysis,
            topics,
            names[node.name],
            topics.class_types,
            _seen(node, reactive, names[node.name]),
        )
        own = list(bodies(reactive)) if reactive else []
        found[node.name] = CppClass(
            package,
            node,
            topics.class_types[node.name],
            tuple(topics.class_types[b] for b in node.bases),
            names[node.name],
            CppStatements(
                expressions, remarks, read_declarations(own, analysis), hoisted(own, analysis)
            ),
            _remarks_above(reactive, remarks) if reactive else {},
        )
    return found


def _remarks_above(declaration: ReactiveClass, remarks: Remarks) -> dict[int, tuple[str, ...]]:
    """For each body, the comments that stand before its member."""
    found = {}
    at = declaration.queue_span.end
    for member in declaration.members:
        body = getattr(member, "body", None)
        if body is not None:
            found[id(body)] = tuple(remarks.between(at, member.span.start))
        at = member.span.end
    return found


def _seen(node: NodeClass, declaration: ReactiveClass | None, names: CppNames) -> dict[int, str]:
    """For each `?(...)` of a sensor server, the C++ that samples the sensor."""
    if declaration is None:
        return {}
    servers = {m.name: m for m in declaration.members if isinstance(m, MessageServer)}
    return {
        id(choice): f"{names.sensors[sensor.server]}.seen(&{function})"
        for sensor in node.sensors
        for choice, function in zip(
            draws_of(servers[sensor.server]), names.seen[sensor.server], strict=True
        )
    }


def _stand_in(package: Package, node: NodeClass) -> str:
    sensors = [
        {
            "name": s.name,
            "type": s.type,
            "period": s.period,
            "draws": [
                (d.field, _choices(cpp_type(d.type), [cpp_value(v) for v in d.alternatives]))
                for d in s.draws
            ],
        }
        for s in node.sensors
        if s.stands_in
    ]
    includes = sorted(f"{package.name}/{s['type']}.h" for s in sensors)
    return fill(
        "ros1_cpp/stand_in.cpp.j2",
        package=package.name,
        node=node,
        sensors=sensors,
        includes=includes,
    )


def _choices(type_: str, values: list[str]) -> str:
    return f"std::initializer_list<{type_}>{{{', '.join(values)}}}"
