"""Directories held open: what is below one is reached part by part, and no link is followed.

A path that was looked at may lead elsewhere by the time that it is opened. A handle does not: so
nothing that comes with a package, or changes while rebsync works, makes it read or write outside.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from types import TracebackType

from rebsync.diagnostics import RebsyncError

_NO_LINK = getattr(os, "O_NOFOLLOW", 0)
_FOLDER = os.O_RDONLY | getattr(os, "O_DIRECTORY", 0) | getattr(os, "O_CLOEXEC", 0)
# Without waiting for who writes a pipe, and without becoming the owner of a terminal.
_FILE = os.O_RDONLY | _NO_LINK | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0)
_ON_THE_WAY = (os.O_PATH if hasattr(os, "O_PATH") else os.O_RDONLY) | (_FOLDER & ~os.O_RDONLY)
_HINT = "put the file or directory itself here"
_ODD = frozenset({"", ".", ".."})
_KINDS = {
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}


class Folder:
    """A directory that is held open until its `with` ends; `path` is what users are told.

    Files and directories below go by relative paths with slashes.
    """

    __slots__ = ("_inner", "path")

    def __init__(self, path: str, handle: int | None = None) -> None:
        """OSError: there is no such directory, or it may not be read."""
        self.path = path
        self._inner = {"": opened(os.path.realpath(path)) if handle is None else handle}

    def __enter__(self) -> Folder:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
        /,
    ) -> None:
        for handle in self._inner.values():
            os.close(handle)
        self._inner.clear()

    @property
    def handle(self) -> int:
        """What calls of the operating system know the directory by."""
        return self._inner[""]

    def inner(self, name: str, created: list[tuple[int, str]] | None = None) -> int:
        """The handle of a directory below, which is made where `created` is to tell of that.

        OSError: there is no such directory. RebsyncError: a link is in the way.
        """
        if name in self._inner:
            return self._inner[name]
        above, _, last = name.rpartition("/")
        if last in _ODD or "\0" in last:
            raise self._odd(name)
        outer = self.inner(above, created)
        try:
            handle = os.open(last, _FOLDER | _NO_LINK, dir_fd=outer)
        except FileNotFoundError:
            if created is None:
                raise
            handle = self._made(outer, last, name, created)
        except OSError:
            self._refuse_link(outer, last, name)
            raise
        self._inner[name] = handle
        return handle

    def place(self, name: str, created: list[tuple[int, str]] | None = None) -> tuple[int, str]:
        """The handle of the directory that a file is in, and its name there; as `inner`."""
        above, _, last = name.rpartition("/")
        if last in _ODD or "\0" in last:
            raise self._odd(name)
        handle = self._inner.get(above)
        return self.inner(above, created) if handle is None else handle, last

    def status(self, name: str) -> os.stat_result | None:
        """What is known of a regular file; None where there is nothing of this name.

        RebsyncError: it is a link, or no regular file, or behind a link.
        """
        try:
            handle, last = self.place(name)
            found = os.stat(last, dir_fd=handle, follow_symlinks=False)
        except (FileNotFoundError, NotADirectoryError):
            return None
        self._refuse_link(handle, last, name, found)
        refuse_special(f"{self.path}/{name}", found)
        return found

    def open(self, name: str, is_seen: bool = False) -> int:
        """A handle to read a regular file. OSError, RebsyncError: it cannot be opened.

        `is_seen`: a moment ago it was a regular file, so that it is looked at when it is open.
        """
        handle, last = self.place(name)
        if is_seen:
            with suppress(OSError):
                return open_regular(last, f"{self.path}/{name}", None, handle)
        found = os.stat(last, dir_fd=handle, follow_symlinks=False)
        self._refuse_link(handle, last, name, found)
        return open_regular(last, f"{self.path}/{name}", found, handle)

    def read(self, name: str, is_seen: bool = False) -> bytes:
        """The bytes of a regular file; as `open`. OSError, RebsyncError: it cannot be read."""
        return content_of(self.open(name, is_seen))

    def files(self, name: str = "") -> Iterator[str]:
        """The files in and below a directory, in the order of their names.

        RebsyncError: one is a link, or no regular file. None where there is no such directory.
        """
        try:
            handle = self.inner(name)
        except (FileNotFoundError, NotADirectoryError):
            return
        with os.scandir(handle) as entries:
            every = sorted(entries, key=lambda e: e.name)
        for entry in every:
            inside = f"{name}/{entry.name}" if name else entry.name
            if entry.is_dir(follow_symlinks=False):
                yield from self.files(inside)
            elif self.status(inside) is not None:
                yield inside

    def take(self, name: str) -> int:
        """A handle of a directory below that is not closed with this one."""
        return os.dup(self.inner(name))

    def remove(self, name: str) -> None:
        """Takes away a file, or a directory with all that is in it. OSError: it does not go."""
        handle, last = self.place(name)
        found = os.stat(last, dir_fd=handle, follow_symlinks=False)
        if not stat.S_ISDIR(found.st_mode):
            os.unlink(last, dir_fd=handle)
            return
        for _, folders, files, inner in os.fwalk(last, topdown=False, dir_fd=handle):
            for each in files:
                os.unlink(each, dir_fd=inner)
            for each in folders:
                os.rmdir(each, dir_fd=inner)
        os.rmdir(last, dir_fd=handle)

    def _made(self, outer: int, last: str, name: str, created: list[tuple[int, str]]) -> int:
        try:
            os.mkdir(last, dir_fd=outer)
        except FileExistsError:  # another process was quicker
            self._refuse_link(outer, last, name)
        else:
            created.append((outer, last))
        return os.open(last, _FOLDER | _NO_LINK, dir_fd=outer)

    def _odd(self, name: str) -> RebsyncError:
        message = "this path leads out of the package"
        return RebsyncError.of(f"{self.path}/{name}", "RS815", message)

    def _refuse_link(
        self, handle: int, last: str, name: str, found: os.stat_result | None = None
    ) -> None:
        found = found or os.stat(last, dir_fd=handle, follow_symlinks=False)
        if stat.S_ISLNK(found.st_mode):
            message = "this is a link, and none is followed here"
            raise RebsyncError.of(f"{self.path}/{name}", "RS813", message, _HINT)


def opened(real: str) -> int:
    """A handle of a real directory, none of whose parts has become a link since."""
    if hasattr(os, "O_NOFOLLOW_ANY") or not hasattr(os, "O_PATH"):
        return os.open(real, _FOLDER | getattr(os, "O_NOFOLLOW_ANY", _NO_LINK))
    handle = os.open(os.sep, _ON_THE_WAY)
    try:
        for part in Path(real).parts[1:]:
            inner = os.open(part, _ON_THE_WAY | _NO_LINK, dir_fd=handle)
            os.close(handle)
            handle = inner
        return os.open(".", _FOLDER, dir_fd=handle)
    finally:
        os.close(handle)


# --- files --------------------------------------------------------------------------------------


def refuse_special(path: str, found: os.stat_result) -> None:
    """RebsyncError: this is a pipe, a device or the like, on which reading might wait for ever."""
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    what = _KINDS.get(stat.S_IFMT(found.st_mode))
    if what is None and found.st_size in (0, 4096) and found.st_dev in _made_by_the_kernel():
        what = "a file that the kernel makes up"
    if what is not None:
        raise RebsyncError.of(path, "RS814", f"this is {what}, not a file")


@cache
def _made_by_the_kernel() -> frozenset[int]:
    """The devices of file systems that are no files, where the system has such."""
    mounted = filter(os.path.ismount, ("/proc", "/sys"))
    return frozenset(Path(path).stat().st_dev for path in mounted)


def open_regular(
    name: str, path: str, found: os.stat_result | None, folder: int | None = None
) -> int:
    """A handle to read a file that is no link, and is told of as `path`; `found` is its status.

    OSError: it cannot be opened. RebsyncError: it is no regular file, now or when it is opened, or
    one that is too large.
    """
    if found is not None:
        refuse_special(path, found)
    handle = os.open(name, _FILE, dir_fd=folder)
    try:
        now = os.fstat(handle)
        refuse_special(path, now)
        if now.st_size > LARGEST:
            raise too_large(path)
    except BaseException:
        os.close(handle)
        raise
    return handle


LARGEST = 64 << 20


def too_large(path: str) -> RebsyncError:
    """The mistake of a file that is not read, as it would fill the memory."""
    return RebsyncError.of(path, "RS806", f"larger than {LARGEST >> 20} MiB, too large to read")


_PART = 1 << 16  # bytes that are read at once; much more is memory from the system for each file


def content_of(handle: int, most: int | None = None) -> bytes:
    """The bytes of an open file, which is closed; of more than `most` a few more than these."""
    try:
        parts = [os.read(handle, _PART)]
        size = len(parts[0])
        while len(parts[-1]) and (most is None or size <= most):
            parts.append(os.read(handle, _PART))
            size += len(parts[-1])
        return b"".join(parts)
    finally:
        os.close(handle)
