"""Generation as one expression over stages: model -> package value -> files."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from importlib.resources import files
from typing import TypeAlias

from rebsync.config import Config
from rebsync.forward.headers import headed
from rebsync.forward.py_layout import formatted
from rebsync.forward.remarks import Comment, Remarks
from rebsync.forward.topics import Topics
from rebsync.forward.view import view
from rebsync.model import Model
from rebsync.names import CPP_KEYWORDS, PYTHON_KEYWORDS, snake_case
from rebsync.package import Package
from rebsync.static import Analysis

_ROS_PACKAGES = frozenset(
    {
        *(
            "catkin",
            "diagnostic_msgs",
            "genmsg",
            "geometry_msgs",
            "message_generation",
            "message_runtime",
            "nav_msgs",
        ),
        *("rosconsole", "roscpp", "rosgraph_msgs", "roslaunch", "rospy", "sensor_msgs", "std_msgs"),
    }
)


Renderer: TypeAlias = Callable[[Package, Analysis, Topics, Remarks, str], dict[str, str]]


def package_name(stem: str, config: Config) -> str:
    """The name of the package: as configured, else after the model's file (REP 144)."""
    if config.package:
        return config.package
    words = re.sub(r"[^A-Za-z0-9]+", "_", stem).strip("_")
    name = snake_case(words if words[:1].isalpha() else f"model_{words}".rstrip("_"))
    is_module = config.target.endswith("-py") and name in sys.stdlib_module_names
    return f"{name}_nodes" if is_taken(name) or is_module else name


def is_taken(name: str) -> bool:
    """Whether ROS, C or C++ use the name, so that no package can have it."""
    if name in _ROS_PACKAGES or name in CPP_KEYWORDS | PYTHON_KEYWORDS:
        return True
    text = files("rebsync.forward").joinpath("c_names.txt").read_text(encoding="ascii")
    return name in text.split("\n")


def generate(
    model: Model,
    comments: tuple[Comment, ...],
    analysis: Analysis,
    config: Config,
    stem: str,
) -> dict[str, str]:
    """The files of the package by path; `analysis` must be free of errors."""
    package, topics = view(model, analysis, config, package_name(stem, config))
    targets = {c.name: config.target_of(c.name) for c in package.classes}
    # An interface alone has no node, so that it needs no language of its own.
    of_nodes = {targets[c.name] for c in package.classes if not c.interface}
    if len(of_nodes) > 1:
        from rebsync.forward.ros1_mixed import render_mixed

        name = f"{stem}.rebeca"
        files = render_mixed(package, analysis, topics, Remarks(comments), name, targets)
        return headed(formatted(files), config)
    render = _renderer(next(iter(of_nodes), config.target))
    files = render(package, analysis, topics, Remarks(comments), f"{stem}.rebeca")
    if config.shared_runtime:
        from rebsync.forward.runtime_package import without_runtime

        files = without_runtime(files, package.name, config.target)
    return headed(formatted(files), config)


def _renderer(target: str) -> Renderer:
    """What writes a package in a dialect."""
    match target:
        case "ros1-cpp":
            from rebsync.forward import ros1_cpp

            return ros1_cpp.render
        case "ros1-py":
            from rebsync.forward import ros1_py

            return ros1_py.render
        case "ros2-cpp":
            from rebsync.forward import ros2_cpp

            return ros2_cpp.render
        case "ros2-py":
            from rebsync.forward import ros2_py

            return ros2_py.render
        case _:
            raise ValueError(target)
