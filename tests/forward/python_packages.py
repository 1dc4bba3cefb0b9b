"""Imports generated Python packages without ROS: what client libraries do is left out."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module, invalidate_caches
from pathlib import Path
from types import ModuleType
from unittest.mock import MagicMock

_LIBRARIES = ("diagnostic_msgs", "geometry_msgs", "rosgraph_msgs", "sensor_msgs", "std_msgs")


@contextmanager
def imported(package: Path, module: str) -> Iterator[ModuleType]:
    """A module of a package of ROS 1 while the block runs."""
    name = package.name
    before = set(sys.modules)
    sys.path.insert(0, str(package / "src"))
    sys.modules["rospy"] = _rospy()
    for library in _LIBRARIES:
        _messages(library)
    try:
        invalidate_caches()
        import_module(name)
        _messages(name)
        yield import_module(f"{name}.{module}")
    finally:
        sys.path.remove(str(package / "src"))
        for added in set(sys.modules) - before:
            del sys.modules[added]


def _messages(package: str) -> None:
    messages = MagicMock()
    messages.__spec__ = None
    messages.__path__ = []
    sys.modules.setdefault(package, messages)
    sys.modules[f"{package}.msg"] = MagicMock()


def _rospy() -> MagicMock:
    rospy = MagicMock()
    rospy.get_name.return_value = "/rebec"
    rospy.get_param.side_effect = lambda name, default=None: default
    return rospy
