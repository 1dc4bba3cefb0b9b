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


def tree_of_code(root: str, named: str) -> str:
    """The real directory in which code of a package may be behind links.

    Without a repository it is the directory that a user named or is in, or else the package itself.
    """
    here = os.path.realpath(root)
    if (tree := repository(here)) is not None:
        return tree
    chosen = map(os.path.realpath, (named, os.curdir))
    return min((folder for folder in chosen if is_within(here, folder)), key=len, default=here)


def repository_of_link(link: str) -> str | None:
    """The working tree of git that a link itself lies in, wherever it leads."""
    return repository(os.path.realpath(os.path.dirname(link) or os.curdir))  # noqa: PTH120


def leads_out(link: str, real: str, named: str | None = None) -> bool:
    """Whether a link to a real path leads out of the repository that it lies in.

    Where it lies in none, out of the directory that a user named, if it was found there.
    """
    tree = repository_of_link(link)
    if tree is None and named is not None:
        tree = os.path.realpath(named)
    return tree is not None and not is_within(real, tree)


def is_within(real: str, tree: str) -> bool:
    """Whether a real path is of a tree: in it, and not of what git keeps for itself."""
    if real == tree:
        return True
    head = tree.rstrip(os.sep) + os.sep
    if not real.startswith(head):
        return False
    return all(part.casefold() != GIT for part in Path(real.removeprefix(head)).parts)
