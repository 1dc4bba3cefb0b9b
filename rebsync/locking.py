"""One process at a time writes a tree, and what a killed one left behind is taken away."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import operating_on
from rebsync.folder import Folder
from rebsync.writing import STAGED, make_folder


@contextmanager
def alone_in(root: str, *files: str) -> Iterator[None]:
    """One process at a time writes the tree `root`, and `files` that may lie elsewhere.

    What a killed one left behind is taken away.
    """
    folder = Path(root)
    created: list[Path] = []
    with operating_on(root):
        make_folder(folder.parent, created)
    folders = {os.path.realpath(path.parent) for path in (folder, *map(Path, files))}
    try:
        with ExitStack() as locks:
            for each in sorted(folders):  # in one order, so that no two wait for each other
                locks.enter_context(_locked(Path(each)))
            _clear(folder)
            for file in map(Path, files):
                _clear_beside(file.resolve())
            yield
    finally:
        for made in reversed(created):
            with suppress(OSError):
                made.rmdir()


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Holds the folder's lock, where the system has such locks."""
    handle = None
    with suppress(OSError, ImportError):
        import fcntl

        handle = os.open(folder, os.O_RDONLY)
        fcntl.flock(handle, fcntl.LOCK_EX)
    try:
        yield
    finally:
        if handle is not None:
            os.close(handle)


def _clear(root: Path) -> None:
    _clear_beside(Path(os.path.realpath(root)))
    with suppress(OSError), Folder(str(root)) as tree:
        for _, _, names, folder in os.fwalk(".", dir_fd=tree.handle):
            for name in filter(STAGED.match, names):
                with suppress(OSError):
                    os.unlink(name, dir_fd=folder)


def _clear_beside(file: Path) -> None:
    with suppress(OSError, RebsyncError), Folder(str(file.parent)) as folder:
        for name in os.listdir(folder.handle):  # noqa: PTH208 - of a handle
            if name.startswith(f".{file.name[:100]}.") and STAGED.match(name):
                folder.remove(name)
