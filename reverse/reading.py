"""Finds the files that belong to what a user names: a file, a directory, a package."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import operating_on, read_source
from rebsync.records import dataclass
from rebsync.source import Source

_MANIFEST = "package.xml"
_SKIPPED = frozenset({"build", "devel", "install", "log", "node_modules", "test", "tests"})
_READ = frozenset(
    {
        *(".h", ".hh", ".hpp", ".hxx", ".c", ".cc", ".cpp", ".cxx"),
        *(".launch", ".msg", ".yaml", ".yml", ".xml", ".txt"),
    }
)


@dataclass(frozen=True, slots=True)
class Chosen:
    """The files of a package or directory by path in it, and the one that is asked for, if one."""

    files: dict[str, Source]
    only: str | None


def chosen(path: str) -> Chosen:
    """What a path stands for: a file together with the package around it, or a directory.

    RebsyncError: there is no such path, or a file of it cannot be read.
    """
    here = Path(path)
    with operating_on(path):
        if here.is_dir():
            return Chosen(_files(here), None)
        read_source(path)  # says what is wrong with it
    root = _package_around(here)
    if root is None:
        return Chosen({here.name: read_source(path)}, here.name)
    inside = here.resolve().relative_to(root.resolve()).as_posix()
    return Chosen({**_files(root), inside: read_source(path)}, inside)


def _package_around(file: Path) -> Path | None:
    """The nearest directory above a file that is a package."""
    return next((d for d in file.resolve().parents if (d / _MANIFEST).is_file()), None)


def _files(root: Path) -> dict[str, Source]:
    found = {}
    for path in _walk(root):
        try:
            found[path.relative_to(root).as_posix()] = read_source(str(path))
        except RebsyncError:
            if path.suffix not in (".xml", ".txt", ".yaml", ".yml"):
                raise
    return found


def _walk(root: Path) -> Iterator[Path]:
    """The files that may matter, in an order that is the same everywhere."""
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(d for d in folders if d not in _SKIPPED and not d.startswith("."))
        yield from (Path(folder, n) for n in sorted(names) if Path(n).suffix in _READ)
