"""Contents of the files of a listing, read with no links but those that were looked at."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rebsync.files import read_bytes
from rebsync.folder import Folder

if TYPE_CHECKING:
    from rebsync.reverse.files.packages import Listing


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
        return None if path.startswith("/") else path.removeprefix("./")
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
