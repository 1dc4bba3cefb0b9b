"""Libraries of C++ of which it is known what throws, by what their functions are documented to do.

What tables do not have of another library may throw anything ([except.spec]: a function without a
specification may). These were looked through: what throws of them is in `thrown_by_others.py` and
`outcome_rules.py`, and all else of them does not, but for what memory, the network, and programs
that were written wrong may always do.
"""

from __future__ import annotations

import re

from rebsync.reverse.libraries import cpp

# Outermost namespaces: of client libraries, of what they send, of what transforms and plans.
_SCOPES = frozenset(
    {
        *("ros", "rclcpp", "rclcpp_lifecycle", "rclcpp_action", "rclcpp_components", "rmw"),
        *("actionlib", "message_filters", "image_transport", "nodelet", "dynamic_reconfigure"),
        *("diagnostic_updater", "realtime_tools", "topic_tools", "tf", "tf2", "tf2_ros"),
        *("angles", "Eigen", "testing", "message", "builtin_interfaces", "rosidl_runtime_cpp"),
    }
)
_MESSAGES = re.compile(
    r"\w+(?:_msgs|_srvs|_interfaces)(?:::|/|\Z)|(?:\w+::)*(?:msg|srv|action)::|\w+/\w+\Z"
)
# Of matrices whose sizes are computed, assertions look at the sizes of operands and at indices.
_COMPUTED = re.compile(
    r"Eigen::(?:Matrix|Vector|RowVector|Array|SparseMatrix|SparseVector)\w*X|Eigen::\w+<.*Dynamic"
)


# Parts of boost that are functions of values.
_QUIET = ("boost::algorithm::", "boost::ignore_unused", "boost::math::", "boost::posix_time::")
# What the functions of other libraries throw, by the namespace, where that is known.
_THROWN = {
    "cv": "cv::Exception",
    "cv_bridge": "cv_bridge::Exception",
    "image_geometry": "image_geometry::Exception",
    "nlohmann": "nlohmann::json::exception",
    "YAML": "YAML::Exception",
    "Json": "Json::Exception",
    "pcl": "pcl::PCLException",
    **dict.fromkeys(("std", "boost"), "std::exception"),
}


_ASKING = frozenset({"rows", "cols", "size", "norm", "squaredNorm", "data", "setZero", "resize"})


def thrown_by(name: str) -> str:
    """The exception that a function may throw of which no table has more than its name."""
    return _THROWN.get(name.partition("::")[0], "an exception")


def is_looked_through(name: str) -> bool:
    """Whether a full name is of such a library, or of none: those of C throw nothing."""
    name = name.removeprefix("new ").removeprefix("::")
    scope, _, last = name.partition("::")
    if _COMPUTED.match(name):  # but to declare one, or to ask it
        return not last.partition("::")[2] or name.rpartition("::")[2] in _ASKING
    if name.rpartition("::")[2] in ("what", "c_str"):
        return True
    if any(each.endswith("Ptr") for each in name.split("::")):  # smart pointers, by custom
        return True
    if name.startswith(_QUIET):
        return True
    return not last or scope in _SCOPES or _MESSAGES.match(name) is not None


def is_library(name: str) -> bool:
    """Whether a full name is of a library that the tables know, or of a message."""
    first, scope, rest = name.removeprefix("::").partition("::")
    if not scope:
        return False
    known = {x.removesuffix("::") for x in cpp.scopes()} | cpp.copying_scopes()
    is_message = any(f"{kind}::" in rest for kind in ("msg", "srv", "action"))
    return first in known or is_message or first.endswith(("_msgs", "_srvs"))
