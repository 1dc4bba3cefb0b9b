"""The run-time part that packages of a workspace share, as the records of each of them have it.

A manifest names its files by `~/PACKAGE/path/in/package`, as extraction names those of packages
beside one, and `.rebsync/base/` keeps their texts.
"""

from __future__ import annotations

import os
from collections.abc import Iterable

from rebsync.config import Config
from rebsync.reverse.files.packages import BESIDE

_RECORDED = (".h", ".hpp", ".py", ".msg")


def shared_runtime(config: Config) -> dict[str, str]:
    """The files of the run-time part by the names that records have for them; none of its own."""
    if not config.shared_runtime:
        return {}
    from rebsync.forward.runtime_package import runtime_packages

    files = runtime_packages(config.target).items()
    return {f"{BESIDE}{p}": t for p, t in files if p.endswith(_RECORDED) and not _is_build(p)}


def _is_build(path: str) -> bool:
    return path.endswith("/setup.py")


def is_shared(name: str) -> bool:
    """Whether a record means a file of a package beside the one that it is of."""
    return name.startswith(BESIDE)


def inside(name: str) -> str:
    """The path of a file in its own package."""
    return name.split("/", 2)[2] if is_shared(name) else name


def folders_beside(root: str, names: Iterable[str]) -> frozenset[str]:
    """The real paths of the packages of which the records of the one at `root` have files."""
    shared = {name.removeprefix(BESIDE).partition("/")[0] for name in names if is_shared(name)}
    return frozenset(os.path.realpath(f"{root}/../{folder}") for folder in shared)


def path_beside(root: str, name: str) -> str:
    """Where a file is that the records of the package at `root` have: in the folder around it."""
    return os.path.normpath(f"{root}/../{name.removeprefix(BESIDE)}")
