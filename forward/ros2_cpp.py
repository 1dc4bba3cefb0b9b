"""ROS 2 C++ (rclcpp, Humble and later): a package value as the files of an ament package."""

from __future__ import annotations

from rebsync.forward import ros2_words
from rebsync.forward.cpp_class import CppClass
from rebsync.forward.cpp_classes import classes
from rebsync.forward.cpp_files import header, sensor_header, source
from rebsync.forward.message_files import message_files
from rebsync.forward.readme import readme
from rebsync.forward.remarks import Remarks
from rebsync.forward.ros2_constructors import (
    access,
    constructor_declarations,
    constructor_definitions,
    managed,
    node_main,
    registration,
    root,
)
from rebsync.forward.ros2_package import cmake_lists, launch_file, manifest, parameters
from rebsync.forward.runtime_part import cpp_runtime, cpp_stand_in
from rebsync.forward.templating import fill
from rebsync.forward.topics import Topics
from rebsync.package import Package
from rebsync.static import Analysis

_SENSORS = "include/{package}/{file}_sensors.hpp"


def render(
    package: Package, analysis: Analysis, topics: Topics, remarks: Remarks, model_name: str
) -> dict[str, str]:
    """The files of the package by path, relative to its folder."""
    found = list(classes(package, analysis, topics, remarks, ros2_words).values())
    files: dict[str, str] = {
        "package.xml": manifest(package),
        "CMakeLists.txt": cmake_lists(package, found),
        ".clang-format": fill("ros2_cpp/clang-format.j2"),
        ".flake8": fill("py/flake8.j2"),
        "ruff.toml": fill("py/ruff.toml.j2", packages=[package.name]),
        "CPPLINT.cfg": fill("ros2_cpp/cpplint.cfg.j2", copyright=package.copyright),
        "README.md": readme(package, model_name, "ros2_cpp", _SENSORS),
        f"launch/{package.name}.launch.py": launch_file(package),
        "config/params.yaml": parameters(package),
    }
    files.update(message_files(package))
    files.update(cpp_runtime(package, ros2_words))
    for c in found:
        files.update(_class_files(c, model_name))
    if package.monitored:
        from rebsync.forward.monitor import cpp_monitor

        files.update(cpp_monitor(package, analysis, ros2_words, model_name))
    return dict(sorted(files.items()))


def _class_files(c: CppClass, model_name: str) -> dict[str, str]:
    include = f"include/{c.package.name}/{c.node.file}"
    declared = header(c, model_name, constructor_declarations(c), access(c), root(c), managed(c))
    files = {f"{include}.hpp": declared}
    if c.node.interface:
        return files
    files[f"src/{c.node.file}.cpp"] = source(c, constructor_definitions(c), registration(c))
    if c.node.executable:
        files[f"src/{c.node.file}_node.cpp"] = node_main(c)
    if any(s.draws for s in c.node.sensors):
        files[f"{include}_sensors.hpp"] = sensor_header(c)
    if any(s.stands_in for s in c.node.sensors):
        files[f"src/{c.node.file}_stand_in.cpp"] = cpp_stand_in(c.package, c.node, ros2_words)
    return files
