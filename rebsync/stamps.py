"""Whether somebody else has changed files while a command worked on them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import TypeAlias

from rebsync.diagnostics import RebsyncError
from rebsync.records import dataclass

_Stamp: TypeAlias = tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class Stamps:
    """Files as they were at a moment: when they changed last, how large they were, which they were.

    `folders` are those that were looked into. Hidden ones are not, nor what is behind links to
    others.
    """

    files: dict[str, _Stamp]
    folders: frozenset[str]

    def refuse_changed(self, paths: Iterable[str]) -> None:
        """RebsyncError: one of the files is not as it was. Those of other folders do not count."""
        for each in paths:
            path = _real(Path(each).parent) / Path(each).name
            old = self.files.get(str(path))
            if old is None and str(path.parent) not in self.folders:
                continue
            if _stamp(path) != old:
                message = "this has changed while rebsync worked, so nothing was written"
                raise RebsyncError.of(each, "RS812", message, "run the command again")


def stamps(root: str, *files: str) -> Stamps:
    """The files below `root`, and `files` that may lie elsewhere, as they are now."""
    found: dict[str, _Stamp] = {}
    folders = []
    ahead = [str(_real(Path(root)))]
    while ahead:
        folder = ahead.pop()
        with suppress(OSError), os.scandir(folder) as entries:
            folders.append(folder)
            for entry in entries:
                if entry.is_dir(follow_symlinks=False):
                    ahead += [entry.path] if entry.name[0] != "." else []
                elif stamp := _stamp(entry):
                    found[entry.path] = stamp
    for path in map(_real, map(Path, files)):
        if stamp := _stamp(path):
            found[str(path)] = stamp
    return Stamps(found, frozenset(folders))


def _real(path: Path) -> Path:
    return Path(os.path.realpath(path))


def _stamp(file: Path | os.DirEntry[str]) -> _Stamp | None:
    try:
        about = file.stat()
    except OSError:
        return None
    return about.st_mtime_ns, about.st_size, about.st_ino
