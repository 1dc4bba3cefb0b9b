"""The packages that build files ask for, and whether a file uses what a package offers."""

from __future__ import annotations

import re
from collections.abc import Collection

from rebsync.reverse.build.cmake import BUILD, read_build
from rebsync.reverse.build.manifests import read_manifest
from rebsync.reverse.build.standard_modules import is_standard
from rebsync.reverse.files.packages import CODE
from rebsync.reverse.files.python_files import SUFFIX
from rebsync.reverse.libraries.cpp import including
from rebsync.reverse.libraries.registry import brings
from rebsync.source import Source

_CODE = (*sorted(CODE), SUFFIX)
_INTERFACES = (".msg", ".srv", ".action")
# What is there wherever launch files of Python are started.
_LAUNCHING = frozenset(
    {"ament_index_python", "composition_interfaces", "launch", "launch_ros", "launch_xml"}
    | {"launch_yaml", "lifecycle_msgs", "osrf_pycommon", "yaml"}
)
# Modules whose packages rosdep names otherwise.
_OTHERWISE = {"cv2": "opencv", "google": "protobuf", "sklearn": "scikit", "RPi": "rpi.gpio"}
_TESTS = "test"  # of Python's library, which nothing else of it imports
_OF_INTERFACES = re.compile(r"message_(?:generation|runtime)|rosidl_default_\w+")


def asked_for(path: str, source: Source) -> frozenset[str]:
    """The packages that a package.xml depends on, or that a CMakeLists.txt looks for."""
    if path.endswith(BUILD):
        return read_build(source).packages
    return frozenset(read_manifest(source).depends)


def uses(path: str, source: Source, package: str) -> bool:
    """Whether a file includes or imports what a package offers, or is made into code by it."""
    if _OF_INTERFACES.fullmatch(package):
        return path.endswith(_INTERFACES)
    if not path.endswith(_CODE):
        return False
    word = re.escape(including().get(package, package))
    asks = rf"(?:#\s*include\s*[<\"]|\bfrom\s+|\bimport\s+){word}\b"
    return re.search(asks, source.text) is not None


def gives_module(depends: Collection[str], module: str) -> bool:
    """Whether one of some dependencies gives a module of Python: one of ROS, or of the system.

    Those of the system are named by rosdep after what they give, as `python3-numpy`.
    """
    brought = {m for name in depends for m in brings().get(name, frozenset())}
    brought |= _LAUNCHING if _LAUNCHING.intersection(depends) else set()
    word = _OTHERWISE.get(module, module).lower().replace("_", "-")
    return module in (*depends, *brought) or any(
        name.startswith("python") and f"-{word}-" in f"{name.lower()}-" for name in depends
    )


def is_of_libraries(name: str) -> bool:
    """Whether the client libraries, or what they import, may mean a module by a name."""
    brought = (name in (library, *modules) for library, modules in brings().items())
    return (is_standard(name) and name != _TESTS) or any(brought)
