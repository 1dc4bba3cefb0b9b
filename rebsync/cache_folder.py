"""Folders that only this user can have written to, for the cache and for the key that seals it.

What lies in a cache decides what rebsync says, and compiled models and templates are code. So no
folder serves that a branch of a repository, or another user of the machine, can put files into.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

_WRITABLE = stat.S_IWGRP | stat.S_IWOTH


class UnsafeFolder(Exception):
    """A folder that somebody else could have written to; `str` says why."""


def private_folder(path: Path) -> Path:
    """The real folder at a path, made for this user alone where there is none.

    UnsafeFolder: it lies in the work tree of a git repository, or others may write to it or put
    something else in its place. OSError: there is none, and it cannot be made.
    """
    named = Path(os.path.abspath(path))  # noqa: PTH100 - links stay, to be looked at too
    folder = Path(os.path.realpath(named))
    above = dict.fromkeys((*named.parents, *folder.parents))
    for place in (named, folder, *above):
        if os.path.lexists(place / ".git"):
            raise UnsafeFolder(f"it lies in the work tree of the git repository {place}")
    for place in above:
        if os.path.lexists(place) and not _keeps_its_entries(place.stat()):
            raise UnsafeFolder(f"others may put another folder in its place in {place}")
    for place in (*reversed(folder.parents), folder):
        if not os.path.lexists(place):
            place.mkdir(mode=0o700, exist_ok=True)
    if not is_ours(folder.stat()):
        raise UnsafeFolder("it belongs to another user, or others may write to it")
    return folder


def is_ours(found: os.stat_result) -> bool:
    """Whether a file or folder is this user's, and nobody else can write to it."""
    ours = not hasattr(os, "geteuid") or found.st_uid == os.geteuid()
    return ours and not found.st_mode & _WRITABLE


def _keeps_its_entries(found: os.stat_result) -> bool:
    """Whether in a folder only this user and root can rename what this user has put there."""
    if hasattr(os, "geteuid") and found.st_uid not in (0, os.geteuid()):
        return False
    if not found.st_mode & _WRITABLE or found.st_mode & stat.S_ISVTX:
        return True
    return not found.st_mode & stat.S_IWOTH and _is_of_one_user(found.st_gid)


def _is_of_one_user(group: int) -> bool:
    """Whether a group is the one that some systems make for this user alone."""
    try:
        from grp import getgrgid
        from pwd import getpwuid

        entry, user = getgrgid(group), getpwuid(os.geteuid())
    except (ImportError, KeyError):
        return False
    return entry.gr_name == user.pw_name and set(entry.gr_mem) <= {user.pw_name}
