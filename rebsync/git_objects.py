"""What a revision of git holds, read from its objects: nothing is laid out on the disk."""

from __future__ import annotations

import errno
import os
import stat
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import IO

from rebsync.diagnostics import RebsyncError
from rebsync.git import conversation
from rebsync.records import dataclass
from rebsync.trees import GIT

_MOST_ENTRIES = 100_000
_MOST_BYTES = 1 << 30
_LARGEST = 64 << 20
_LONGEST = 4096  # characters of a path
_MOST_LINKS = 20
_LINK, _FILE, _FOLDER = 0o120000, 0o100000, 0o040000


@dataclass(frozen=True, slots=True)
class TreeEntry:
    """One name in a tree of git, as an entry of a directory is; `path` is what users are told."""

    name: str
    path: str
    mode: int
    id: str

    def is_dir(self) -> bool:
        """Whether it is a tree itself."""
        return stat.S_IFMT(self.mode) == _FOLDER

    def is_symlink(self) -> bool:
        """Whether it is a link; none is followed."""
        return stat.S_IFMT(self.mode) == _LINK

    def stat(self) -> os.stat_result:
        """The kind of file that it is."""
        return os.stat_result((self.mode, *[0] * 9))


class Revision:
    """The files of a revision, by paths such as `HEAD~3:robots/src/robot.cpp`.

    Objects are read when they are asked for. There is a limit to how many, as a few small ones can
    stand for more files than any disk has.
    """

    def __init__(self, name: str, top: str, pipes: tuple[IO[bytes], IO[bytes]]) -> None:
        """`name` is that of the revision, `top` the id of its tree."""
        self.root = f"{name}:"
        self._pipes = pipes
        self._entries, self._bytes = 0, 0
        self._top = TreeEntry("", self.root, _FOLDER, top)
        self._trees: dict[str, dict[str, TreeEntry]] = {}

    def path(self, inside: str) -> str:
        """What a path from the top is told as."""
        return f"{self.root}{inside}"

    def entry(self, path: str) -> TreeEntry | None:
        """What is there by a path, links followed as long as they lead nowhere else.

        RebsyncError: a tree on the way is damaged, or means harm.
        """
        found = [self._top]
        ahead = deque(path.removeprefix(self.root).split("/"))
        links = 0
        while ahead:
            match ahead.popleft():
                case "" | ".":
                    continue
                case "..":
                    found.pop()
                case part:
                    here = self._tree(found[-1]).get(part) if found[-1].is_dir() else None
                    if here is None or links > _MOST_LINKS:
                        return None
                    if here.is_symlink():
                        links += 1
                        ahead.extendleft(reversed(self._target(here)))
                    else:
                        found.append(here)
            if not found:
                return None
        return found[-1]

    def _target(self, link: TreeEntry) -> list[str]:
        """The parts of what a link leads to; those of one that leads out lead to nothing."""
        target = os.fsdecode(self._object(link.id, link.path, b"blob"))
        return target.split("/") if len(target) <= _LONGEST and target[:1] != "/" else [".."] * 9999

    def identity(self, folder: str) -> object:
        """By what a directory is known to have been seen: its path without links."""
        found = self.entry(folder)
        return found.path if found is not None else folder

    def entries(self, folder: str) -> list[TreeEntry]:
        """What is in a directory, by the path that it was reached by. OSError: there is none."""
        found = self.entry(folder)
        if found is None or not found.is_dir():
            raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR))
        return [self._reached(each, folder) for each in self._tree(found).values()]

    def _reached(self, each: TreeEntry, folder: str) -> TreeEntry:
        path = self._below(folder, each.name)
        real = self.entry(path) if each.is_symlink() else None
        return replace(real or each, name=each.name, path=path)

    def exists(self, path: str) -> bool:
        """Whether there is anything by a path."""
        return self.entry(path) is not None

    def is_folder(self, path: str) -> bool:
        """Whether a directory is there. OSError: nothing is."""
        found = self.entry(path)
        if found is None:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))
        return found.is_dir()

    def head(self, path: str) -> bytes:
        """The first bytes of a file, and all others; as `read`."""
        return self.read(path)

    def read(self, path: str) -> bytes:
        """The bytes of a file. OSError, RebsyncError: it cannot be read."""
        found = self.entry(path)
        if found is None or stat.S_IFMT(found.mode) != _FILE:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))
        return self._object(found.id, path, b"blob")

    def _below(self, folder: str, name: str) -> str:
        path = f"{folder}{'' if folder == self.root else '/'}{name}"
        if len(path) > _LONGEST:
            raise _too_much(self.root, "paths longer than those of files")
        return path

    def _tree(self, of: TreeEntry) -> dict[str, TreeEntry]:
        if of.path not in self._trees:
            data = self._object(of.id, of.path, b"tree")
            found: dict[str, TreeEntry] = {}
            for mode, name, id_ in _parts(data, len(of.id) // 2, of.path):
                if not _is_name(name) or name in found:
                    message = f"a tree of git has an entry {name!r}, as git itself makes none"
                    raise RebsyncError.of(of.path, "RS815", message)
                found[name] = TreeEntry(name, self._below(of.path, name), mode, id_)
            self._entries += len(found)
            if self._entries > _MOST_ENTRIES:
                raise _too_much(of.path, f"more than {_MOST_ENTRIES:,} files")
            self._trees[of.path] = found
        return self._trees[of.path]

    def _object(self, id_: str, path: str, wanted: bytes) -> bytes:
        """The bytes of an object. RebsyncError: it is not there, or too large."""
        give, take = self._pipes
        try:
            give.write(f"{id_}\n".encode("ascii"))
            give.flush()
        except OSError:
            raise _lost(path) from None
        match take.readline().split():
            case [_, kind, size] if kind == wanted:
                length = int(size)
            case _:
                raise _lost(path)
        self._bytes += length
        if length > _LARGEST:
            raise _too_much(path, f"larger than {_LARGEST >> 20} MiB")
        if self._bytes > _MOST_BYTES:
            raise _too_much(path, f"more than {_MOST_BYTES >> 30} GiB in all")
        data = take.read(length)
        if len(data) != length or take.read(1) != b"\n":
            raise _lost(path)
        return data


@contextmanager
def revision(name: str, top: str) -> Iterator[Revision]:
    """The files of a revision; `top` is the id of its tree. OSError: there is no git."""
    with conversation("cat-file", "--batch") as pipes:
        yield Revision(name, top, pipes)


def _parts(data: bytes, width: int, path: str) -> Iterator[tuple[int, str, str]]:
    """The entries that the bytes of a tree hold: mode, name, id of so many bytes."""
    at = 0
    while at < len(data):
        blank, end = data.find(b" ", at), data.find(b"\0", at)
        mode = data[at:blank]
        if not at < blank < end or not mode.isdigit() or end + 1 + width > len(data):
            raise _lost(path)
        yield (
            int(mode[:8], 8) if not set(mode) - set(b"01234567") else 0,
            os.fsdecode(data[blank + 1 : end]),
            data[end + 1 : end + 1 + width].hex(),
        )
        at = end + 1 + width


def _is_name(name: str) -> bool:
    """Whether git would take this as the name of a file."""
    return name not in ("", ".", "..") and "/" not in name and name.casefold() != GIT


def _lost(path: str) -> RebsyncError:
    message = "git has no such object, or it is damaged"
    hint = "`git fsck` tells more; what a partial clone lacks, `git fetch` gets"
    return RebsyncError.of(path, "RS806", message, hint)


def _too_much(path: str, what: str) -> RebsyncError:
    return RebsyncError.of(path, "RS806", f"{what}, too large to read")
