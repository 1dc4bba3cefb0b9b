"""ROS 1 C++ (roscpp, Noetic): a package value as the files of a catkin package."""

from __future__ import annotations

from rebsync.forward import ros1_words
from rebsync.forward.cpp_classes import classes
from rebsync.forward.cpp_files import header, sensor_header, source
from rebsync.forward.message_files import message_files
from rebsync.forward.readme import readme
from rebsync.forward.remarks import Remarks
from rebsync.forward.ros1_constructors import (
    access,
    constructor_declarations,
    constructor_definitions,
    node_main,
)
from rebsync.forward.ros1_package import (
    cmake_lists,
    launch_file,
    manifest,
    parameters,
)
from rebsync.forward.runtime_part import cpp_runtime, cpp_stand_in
from rebsync.forward.templating import fill
from rebsync.forward.topics import Topics
from rebsync.package import Package
from rebsync.static import Analysis

_SENSORS = "include/{package}/{file}_sensors.h"


def render(
    package: Package, analysis: Analysis, topics: Topics, remarks: Remarks, model_name: str
) -> dict[str, str]:
    """The files of the package by path, relative to its folder."""
    files: dict[str, str] = {
        "package.xml": manifest(package),
        "CMakeLists.txt": cmake_lists(package),
        ".clang-format": fill("ros1_cpp/clang-format.j2"),
        "README.md": readme(package, model_name, "ros1_cpp", _SENSORS),
        f"launch/{package.name}.launch": launch_file(package),
        "config/params.yaml": parameters(package),
    }
    files.update(message_files(package))
    files.update(cpp_runtime(package, ros1_words))
    for c in classes(package, analysis, topics, remarks, ros1_words).values():
        include = f"include/{package.name}/{c.node.file}"
        files[f"{include}.h"] = header(c, model_name, constructor_declarations(c), access(c))
        if c.node.interface:
            continue
        files[f"src/{c.node.file}.cpp"] = source(c, constructor_definitions(c))
        if c.node.executable:
            files[f"src/{c.node.file}_node.cpp"] = node_main(c)
        if any(s.draws for s in c.node.sensors):
            files[f"{include}_sensors.h"] = sensor_header(c)
        if any(s.stands_in for s in c.node.sensors):
            files[f"src/{c.node.file}_stand_in.cpp"] = cpp_stand_in(package, c.node, ros1_words)
    if package.monitored:
        from rebsync.forward.monitor import cpp_monitor

        files.update(cpp_monitor(package, analysis, ros1_words, model_name))
    return dict(sorted(files.items()))
