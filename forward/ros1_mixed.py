"""ROS 1 packages with classes in C++ and classes in Python: one system, one set of messages."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import replace

from rebsync.forward import ros1_cpp, ros1_package, ros1_py
from rebsync.forward.message_files import action_names, message_names, service_names
from rebsync.forward.remarks import Remarks
from rebsync.forward.templating import fill
from rebsync.forward.topics import Topics
from rebsync.package import Package
from rebsync.static import Analysis

CPP, PYTHON = "ros1-cpp", "ros1-py"

_OF_CLASS = re.compile(
    r"(?:include/[^/]+/|src/(?:[^/]+/)?|scripts/)(\w+?)"
    r"(_node|_sensors|_stand_in)?(?:\.h|\.cpp|\.py)?\Z"
)


def render_mixed(
    package: Package,
    analysis: Analysis,
    topics: Topics,
    remarks: Remarks,
    model_name: str,
    targets: Mapping[str, str],
) -> dict[str, str]:
    """The files of the package by path; `targets` has the dialect of each class."""
    cpp = ros1_cpp.render(package, analysis, topics, remarks, model_name)
    # The monitor is in C++ then.
    unmonitored = replace(package, settings=replace(package.settings, monitor=False))
    python = ros1_py.render(unmonitored, analysis, topics, remarks, model_name)
    stems = {c.file: targets[c.name] for c in package.classes}
    files = {p: t for p, t in python.items() if _stays(p, stems, PYTHON)}
    files |= {p: t for p, t in cpp.items() if _stays(p, stems, CPP)}
    scripts = sorted(p for p in files if p.startswith("scripts/"))
    depends = sorted({*ros1_package.depends_of(package), *ros1_py.depends_of(package)})
    files["package.xml"] = fill("ros1_py/package.xml.j2", package=package, depends=depends)
    files["CMakeLists.txt"] = _cmake_lists(package, depends, scripts, files)
    return dict(sorted(files.items()))


def _stays(path: str, stems: Mapping[str, str], target: str) -> bool:
    """Whether a file of one dialect is one of the package: its class is in that dialect."""
    found = _OF_CLASS.match(path)
    if found is None:
        return True
    whole = f"{found[1]}{found[2] or ''}"
    stem = whole if whole in stems else found[1]
    return stems.get(stem, target) == target


def _cmake_lists(
    package: Package, depends: list[str], scripts: list[str], files: Collection[str]
) -> str:
    return fill(
        "ros1_cpp/CMakeLists.txt.j2",
        package=package.name,
        build_depends=sorted([*depends, "message_generation"]),
        run_depends=sorted([*depends, "message_runtime"]),
        messages=message_names(package),
        services=service_names(package),
        actions=action_names(package),
        library=[s for s in ros1_package.library_of(package) if f"src/{s}.cpp" in files],
        executables=[e for e in package.executables if f"src/{e}.cpp" in files],
        scripts=scripts,
    )
