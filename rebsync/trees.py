"""Which files belong together: a working tree of git, or else what is around a directory."""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

GIT = ".git"


@cache
def repository(folder: str) -> str | None:
    """The working tree of git that a real directory is in."""
    if (Path(folder) / GIT).exists():
        return folder
    above = str(Path(folder).parent)
    return repository(above) if above != folder else None


def tree_of(root: str) -> str:
    """The real directory with all that belongs to a package."""
    here = os.path.realpath(root)
    return repository(here) or str(Path(here).parent)


def is_within(real: str, tree: str) -> bool:
    """Whether a real path is of a tree: in it, and not of what git keeps for itself."""
    if real == tree:
        return True
    head = tree.rstrip(os.sep) + os.sep
    if not real.startswith(head):
        return False
    return all(part.casefold() != GIT for part in Path(real.removeprefix(head)).parts)
