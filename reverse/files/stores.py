"""Where files are: on the disk, or in what git has of a revision."""

from __future__ import annotations

import os
import stat
from collections.abc import Sequence
from typing import Protocol

from rebsync.files import read_bytes
from rebsync.folder import open_regular

_HEAD = 2000  # bytes, by which a file without a suffix is known for a script


class Entry(Protocol):
    """One name in a directory, as `os.DirEntry` has it."""

    @property
    def name(self) -> str: ...
    @property
    def path(self) -> str: ...
    def is_dir(self) -> bool: ...
    def is_symlink(self) -> bool: ...
    def stat(self) -> os.stat_result: ...


class Store(Protocol):
    """Directories and files by their paths."""

    def identity(self, folder: str) -> object:
        """By what a directory is known again, whatever its path. OSError: there is none."""

    def entries(self, folder: str) -> Sequence[Entry]:
        """What is in a directory. OSError: it cannot be read."""

    def exists(self, path: str) -> bool:
        """Whether there is anything by a path."""

    def is_folder(self, path: str) -> bool:
        """Whether a directory is there. OSError: nothing is."""

    def head(self, path: str) -> bytes:
        """The first bytes of a file. OSError, RebsyncError: it cannot be read."""

    def read(self, path: str) -> bytes:
        """The bytes of a file. OSError, RebsyncError: it cannot be read."""


class Disk:
    """Directories and files of the operating system."""

    def identity(self, folder: str) -> object:
        """Device and number of a directory."""
        found = os.stat(folder)  # noqa: PTH116 - a path object for each of many costs more
        return found.st_dev, found.st_ino

    def entries(self, folder: str) -> Sequence[Entry]:
        """What is in a directory."""
        with os.scandir(folder) as entries:
            return list(entries)

    def exists(self, path: str) -> bool:
        """Whether there is anything by a path."""
        return os.path.exists(path)  # noqa: PTH110

    def is_folder(self, path: str) -> bool:
        """Whether a directory is there."""
        return stat.S_ISDIR(os.stat(path).st_mode)  # noqa: PTH116

    def head(self, path: str) -> bytes:
        """The first bytes of a file that is no link."""
        found = os.stat(path, follow_symlinks=False)  # noqa: PTH116
        handle = open_regular(path, path, found)
        try:
            return os.read(handle, _HEAD)
        finally:
            os.close(handle)

    def read(self, path: str) -> bytes:
        """The bytes of a file."""
        return read_bytes(path)


def join(folder: str, name: str) -> str:
    """The path of a name in a directory; `HEAD:` is the top of a revision of git."""
    return f"{folder}{name}" if folder.endswith(":") else f"{folder}/{name}"
