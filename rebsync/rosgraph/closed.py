"""Whether code uses only what asks ROS for nothing that is not in the code itself.

A library that is handed a node can subscribe, offer services and declare parameters of its own. Of
code that uses such a library it is not known which names its node has.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable

from rebsync.source import Source

_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)
_IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import\b|import[ \t]+([\w., \t]+))", re.MULTILINE
)
# Of these the tables of libraries have what asks for something, or they ask for nothing.
_QUIET = frozenset(
    {
        *("ros", "roscpp", "rclcpp", "rclcpp_action", "rclcpp_components", "rclcpp_lifecycle"),
        *("rcl_interfaces", "rclpy", "rospy", "rosidl_runtime_cpp", "builtin_interfaces"),
        *("std_srvs", "message_filters", "cv_bridge", "sensor_msgs_py"),
        *("tf", "tf2", "tf2_ros", "tf2_geometry_msgs", "tf_transformations", "angles", "rcutils"),
        *("action_msgs", "actionlib", "example_interfaces", "roslib", "rcpputils", "rmw"),
        *("Eigen", "boost", "opencv2", "numpy", "cv2", "scipy", "math", "yaml", "pcl", "sys"),
    }
)
_MESSAGES = ("_msgs", "_interfaces", "_srvs")
_LOADS = ("pluginlib", "class_loader", "importlib", "__import__")
_OPEN = (
    *("allow_undeclared_parameters", "automatically_declare_parameters_from_overrides"),
    *("get_node_parameters_interface", "node_interfaces"),
)


def is_closed(sources: Iterable[Source], own: Iterable[str]) -> bool:
    """Whether some files include or import only quiet packages and their own modules."""
    names = frozenset(own)
    return all(_is_closed(source, names) for source in sources)


def _is_closed(source: Source, own: frozenset[str]) -> bool:
    if any(word in source.text for word in (*_LOADS, *_OPEN)):
        return False
    used = _imported(source.text) if _is_python(source) else _included(source.text)
    return all(name in own or name in _QUIET or name.endswith(_MESSAGES) for name in used)


def _is_python(source: Source) -> bool:
    return source.path.endswith(".py") or source.text.startswith("#!")


def _included(text: str) -> set[str]:
    """The folders that headers are included from; those without one are the language's own."""
    paths = (m[1] for m in _INCLUDE.finditer(text))
    return {path.partition("/")[0] for path in paths if "/" in path and not _is_system(path)}


def _is_system(path: str) -> bool:
    return path.startswith(("sys/", "linux/", "netinet/", "arpa/", "bits/"))


def _imported(text: str) -> set[str]:
    found: set[str] = set()
    for match in _IMPORT.finditer(text):
        names = match[1] or match[2]
        found |= {n.strip().partition(" ")[0].partition(".")[0] for n in names.split(",")}
    return {n for n in found if n and n not in sys.stdlib_module_names}
