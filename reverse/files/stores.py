"""Where files are: on the disk, or in what git has of a revision."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Protocol

from rebsync.files import read_bytes
from rebsync.folder import Folder, open_regular

if TYPE_CHECKING:
    from rebsync.reverse.files.packages import Listing

_HEAD = 80  # bytes in which the first line of a script says who runs it


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


class Contents:
    """Reads the files of a listing, with no links but those that it has looked at."""

    __slots__ = ("_linked", "_listing", "_root")

    def __init__(self, listing: Listing, root: Folder | None, linked: Folder | None) -> None:
        """`root` and `linked` are the directories of the package, and of its tree."""
        self._listing, self._root, self._linked = listing, root, linked

    def read(self, name: str) -> bytes:
        """The bytes of a file. OSError, RebsyncError: it cannot be read."""
        listing, path = self._listing, self._listing.files[name]
        if listing.store is not None:
            return listing.store.read(path)
        inside = _inside(listing.root, path)
        if name == listing.only or self._root is None or inside is None:
            return read_bytes(path)
        if self._linked is not None and name in listing.linked:
            linked = os.path.relpath(listing.linked[name], listing.tree)
            return self._linked.read(linked, is_seen=True)
        return self._root.read(inside, is_seen=True)


def _inside(root: str, path: str) -> str | None:
    """The path of a file from its package's directory; None where it does not begin with that."""
    if root == ".":
        return path.removeprefix("./")
    head = f"{root.rstrip('/')}/"
    return path.removeprefix(head) if path.startswith(head) else None


@contextmanager
def contents(listing: Listing) -> Iterator[Contents]:
    """What is in the files of a listing. OSError: its directory is no longer there."""
    if listing.store is not None:
        yield Contents(listing, None, None)
        return
    with Folder(listing.root) as root:
        if not listing.linked:
            yield Contents(listing, root, None)
            return
        with Folder(listing.tree) as tree:
            yield Contents(listing, root, tree)
