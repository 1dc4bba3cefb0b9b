"""Whether all that git would read of a repository is files: on a pipe it would wait without end."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path

from rebsync.folder import content_of, open_regular, refuse_special
from rebsync.trees import GIT

_MOST_ENTRIES = 200_000
_LONGEST = 1 << 16  # bytes of a file that names other directories
_NOT_READ = frozenset({"annex", "hooks", "lfs", "modules", "rr-cache", "worktrees"})
_OF_BARE = ("HEAD", "commondir", "config")


def refuse_special_files(folder: str | None, environment: str | None) -> None:
    """RebsyncError: git would come upon a pipe, a device or the like where it expects a file.

    `folder` is where git is run, or else the current directory; `environment` is its `GIT_DIR`.
    """
    here = os.path.realpath(folder or os.curdir)
    _refuse(here, os.path.join(here, environment) if environment else None)  # noqa: PTH118


@cache
def _refuse(here: str, chosen: str | None) -> None:
    own = chosen or _own(here)
    for path in _entries(own) if own is not None else ():
        _regular(path)


def _own(here: str) -> str | None:
    """The directory that git keeps the nearest repository in; on the way are no bare ones."""
    for folder in (here, *map(str, Path(here).parents)):
        path = f"{folder.rstrip(os.sep)}/{GIT}"
        if (found := _regular(path)) is not None:
            return path if stat.S_ISDIR(found.st_mode) else named_in(path, b"gitdir:")
        for name in _OF_BARE if os.path.lexists(f"{folder}/{_OF_BARE[0]}") else ():
            _regular(f"{folder}/{name}")
    return None


def _regular(path: str) -> os.stat_result | None:
    """What is known of a file or directory, links followed. RebsyncError: it is neither."""
    try:
        found = os.stat(path)  # noqa: PTH116 - of many
    except OSError:
        return None
    with suppress(IsADirectoryError):
        refuse_special(path, found)
    return found


def named_in(path: str, before: bytes = b"") -> str | None:
    """The directory that a file of git names, as that is seen from where the file is."""
    try:
        handle = open_regular(path, path, os.stat(path))  # noqa: PTH116
    except OSError:
        return None
    name = os.fsdecode(content_of(handle, _LONGEST).removeprefix(before).strip())
    return os.path.join(os.path.dirname(path), name)  # noqa: PTH118, PTH120


def _entries(own: str) -> Iterator[str]:
    """What is no plain file in a directory of git, and in those that this names in turn.

    Of very many only the first: there is a limit to how long git is waited for, too.
    """
    waiting: list[tuple[str, bool]] = [(own, True)]
    seen, count = set[str](), 0
    while waiting and count < _MOST_ENTRIES:
        folder, is_top = waiting.pop()
        real = os.path.realpath(folder)
        if real in seen:
            continue
        seen.add(real)
        with suppress(OSError), os.scandir(folder) as entries:
            for entry in entries:
                count += 1
                if entry.is_file(follow_symlinks=False):
                    waiting += _further(entry)
                else:
                    yield entry.path
                    if entry.is_dir() and not (is_top and entry.name in _NOT_READ):
                        waiting.append((entry.path, False))


def _further(entry: os.DirEntry[str]) -> Iterator[tuple[str, bool]]:
    """The directories that a file of git names: what work trees share, objects of others."""
    if entry.name == "commondir" and (shared := named_in(entry.path)) is not None:
        yield shared, True
    if entry.name == "alternates":
        objects = Path(entry.path).parent.parent
        handle = os.open(entry.path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0))
        for line in content_of(handle, _LONGEST).splitlines():
            yield str(objects / os.fsdecode(line)), False
