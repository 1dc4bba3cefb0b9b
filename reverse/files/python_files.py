"""Which files are Python or launch files, and which can matter: told from names and bytes alone."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from rebsync.source import Source

SUFFIX = ".py"
# What says which programs a package of Python installs; no code of nodes.
SETUP = "setup.py"
# How the names of launch files end, and what they import.
LAUNCHES = (".launch.py", "_launch.py", "-launch.py")
_OF_ROS_2 = re.compile(r"[._-]launch\.(?:py|xml|yaml|yml)\Z")
_LAUNCH = (b"launch_ros", b"LaunchDescription")  # the second alone where others are included
_SHEBANG = re.compile(rb"#![^\n]*\bpython")
_IMPORTS_FIRST = re.compile(
    rb"(?!#!)(?:[ \t]*(?:#[^\n]*)?\r?\n)*(?:import[ \t]+\w|from[ \t]+[\w.]+[ \t]+import\b)"
)
_HEAD = 2000  # bytes, in which a script says who runs it, or imports something
_IMPORT = re.compile(rb"[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]+|import[ \t]+)([^#\n]*)")
_NAME = re.compile(rb"\w+")


def is_launch_of_ros_2(path: str) -> bool:
    """Whether a file may be a launch file of ROS 2 by its name."""
    return _OF_ROS_2.search(path) is not None


def is_launch(path: str) -> bool:
    """Whether a file may be a launch file by its name."""
    return path.endswith(".launch") or is_launch_of_ros_2(path)


def has_shebang(head: bytes) -> bool:
    """Whether the first line of a file says that Python runs it."""
    return _SHEBANG.match(head) is not None


def is_script(head: bytes) -> bool:
    """Whether a file without a suffix is Python, by how it begins: catkin runs those as well."""
    return has_shebang(head) or _IMPORTS_FIRST.match(head[:_HEAD]) is not None


def may_be_script(name: str) -> bool:
    """Whether a file of this name may be a script: it has no suffix."""
    return "." not in name and not name.isupper() and name != "Makefile"


def is_python(path: str, source: Source) -> bool:
    """Whether a file that was read is Python."""
    if path.endswith(SUFFIX):
        return True
    if not may_be_script(path.rpartition("/")[2]):
        return False
    return is_script(source.text[:_HEAD].encode("utf-8", "replace"))


def relevant_python(code: Mapping[str, bytes], only: str | None = None) -> set[str]:
    """Those of some files of Python that can matter: those of ROS, and what they import."""
    kept = {name for name, data in code.items() if name == only or _of_ros(data)}
    kept |= {
        n for n, data in code.items() if n.endswith(LAUNCHES) and any(w in data for w in _LAUNCH)
    }
    if kept and SETUP in code and b"console_scripts" in code[SETUP]:
        kept.add(SETUP)
    if not kept or len(kept) == len(code):
        return kept
    by_name: dict[bytes, list[str]] = {}
    for path in code:
        by_name.setdefault(_module(path).encode(), []).append(path)
    waiting = list(kept)
    while waiting:
        names = set(_imported(code[waiting.pop()]))
        fresh = {path for name in names for path in by_name.get(name, ())} - kept
        kept |= fresh
        waiting += fresh
    return kept


def _of_ros(data: bytes) -> bool:
    from rebsync.reverse.libraries.python import (
        marks,  # which commands that read no code do without
    )

    return any(word in data for word in marks())


def _module(path: str) -> str:
    folder, _, name = path.rpartition("/")
    stem = name.removesuffix(SUFFIX)
    return folder.rpartition("/")[2] if stem == "__init__" else stem


def _imported(data: bytes) -> Iterator[bytes]:
    """All names in imports: of modules, and of what may be modules."""
    data = data.replace(b"\r", b"\n")
    at = data.find(b"import")
    while at >= 0:
        found = _IMPORT.match(data, data.rfind(b"\n", 0, at) + 1)
        if found is not None:
            yield from _NAME.findall(found[1] or b"")
            yield from _NAME.findall(found[2])
        at = data.find(b"import", data.find(b"\n", at) if found is not None else at + 1)
