"""The packages of a path as they were in a revision of git."""

from __future__ import annotations

import os
from collections.abc import Sequence

from rebsync.diagnostics import RebsyncError
from rebsync.git import git
from rebsync.git_objects import revision as objects_of
from rebsync.reverse.files.reading import packages
from rebsync.rosgraph.ends import PackageCode
from rebsync.rosgraph.reading import read_package


def packages_of_revision(revision: str, paths: Sequence[str]) -> list[PackageCode]:
    """What paths had in a revision; nothing for one that it does not have.

    RebsyncError: there is no such revision, or a path is not in the repository of the current
    directory.
    """
    tree = None if revision.startswith("-") else _said(f"{revision}^{{commit}}^{{tree}}")
    if not tree:
        message = f'git knows no revision "{revision}" here'
        raise RebsyncError.of(revision, "RS801", message, "run it in the repository")
    inside = [_inside(path) for path in paths]
    with objects_of(revision, tree) as files:
        wanted = [files.path("" if i == "." else i) for i in inside]
        found = [path for path in wanted if files.exists(path)]
        return [read_package(each) for each in packages(found, files)]


def _inside(path: str) -> str:
    """The path from the top of the repository."""
    top = _told("rev-parse", "--show-toplevel")
    inside = os.path.relpath(os.path.realpath(path), os.path.realpath(top)) if top else ".."
    if inside == os.pardir or inside.startswith(f"{os.pardir}{os.sep}"):
        message = "this is not in the repository of the current directory"
        raise RebsyncError.of(path, "RS815", message)
    return inside.replace(os.sep, "/")


def _said(object_: str) -> str:
    return _told("rev-parse", "--verify", "--quiet", object_)


def _told(*arguments: str) -> str:
    try:
        return os.fsdecode(git(*arguments) or b"").strip()
    except OSError as error:
        message = f"git cannot be run: {error.strerror}"
        raise RebsyncError.of(".", "RS806", message) from None
