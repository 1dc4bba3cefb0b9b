"""Which names modules of Python have: those of the client libraries, and of Python's own."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from importlib.util import find_spec
from types import ModuleType

from rebsync.reverse.libraries.registry import derived

_EXCEPTIONS = """
    ROSException ROSInitException ROSInternalException ROSInterruptException
    ROSSerializationException ROSTimeMovedBackwardsException TransportException TransportInitError
    TransportTerminated ServiceException"""
# What modules have, where that is known.
_MODULES: Mapping[str, str] = {
    "rospy": f"""
        AnyMsg DEBUG Duration ERROR FATAL Header INFO MasterProxy Message Publisher Rate Service
        ServiceProxy SubscribeListener Subscriber Time Timer WARN delete_param get_caller_id
        get_master get_name get_namespace get_node_uri get_param get_param_cached get_param_names
        get_published_topics get_ros_root get_rostime get_time has_param init_node is_shutdown
        logdebug logdebug_once logdebug_throttle logdebug_throttle_identical logerr logerr_once
        logerr_throttle logerr_throttle_identical logfatal logfatal_once logfatal_throttle
        logfatal_throttle_identical loginfo loginfo_once loginfo_throttle
        loginfo_throttle_identical logout logwarn logwarn_once logwarn_throttle
        logwarn_throttle_identical myargv on_shutdown parse_rosrpc_uri remap_name resolve_name
        search_param set_param signal_shutdown sleep spin wait_for_message wait_for_service
        client core exceptions impl msg msproxy names numpy_msg rostime service services timer
        topics validators {_EXCEPTIONS}""",
}
# Modules of Python's own library of which nodes ask names; submodules are none.
_OWN_MODULES = frozenset(
    {
        *("abc", "bisect", "collections", "contextlib", "copy", "dataclasses", "datetime"),
        *("decimal", "enum", "functools", "heapq", "itertools", "json", "math", "operator"),
        *("queue", "random", "re", "statistics", "string", "struct", "sys", "threading"),
        *("time", "typing", "uuid", "argparse", "array", "base64", "csv", "errno", "fractions"),
        *("glob", "hashlib", "io", "locale", "logging", "numbers", "os", "pathlib", "pickle"),
        *("platform", "select", "shutil", "signal", "socket", "subprocess", "tempfile"),
        *("textwrap", "traceback", "types", "warnings", "zlib"),
    }
)
# Constants of messages are written in capitals; the rest are what generators add.
_MISSING = object()  # what a module of Python's own does not have


@derived
def in_python(name: str) -> object:
    """What Python's own library has here under a full name; None where that is not known."""
    first, *rest = name.split(".")
    if first not in _OWN_MODULES or not rest:
        return None
    found: object = importlib.import_module(first)
    for part in rest:
        inner = getattr(found, part, _MISSING)
        if inner is _MISSING and _is_module_in(found, part):
            return None  # of which nothing was asked here
        found = inner
        if found is _MISSING:
            return found
    return found


def _is_module_in(package: object, name: str) -> bool:
    """Whether a package has a module, or may have it."""
    if not isinstance(package, ModuleType) or not hasattr(package, "__path__"):
        return False
    return find_spec(f"{package.__name__}.{name}") is not None


@derived
def has_name(name: str) -> bool:
    """Whether there may be a full name; the modules of Python's own have what they have here."""
    module, _, rest = name.partition(".")
    known = _MODULES.get(module)
    if known is None:
        return in_python(name) is not _MISSING
    first = rest.partition(".")[0]
    return first in known.split() or first.startswith("_")
