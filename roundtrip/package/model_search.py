"""Searches what belongs together for the model of a package that is no longer where it was.

As git tells renames: a file with the same text is the same file; one of the same name too, if at
least half of its lines are those of last time. Another name and another text make only a guess.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from difflib import SequenceMatcher
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import read_bytes, read_source
from rebsync.records import dataclass
from rebsync.reverse.files.packages import IGNORING
from rebsync.roundtrip.package.digests import is_text_of
from rebsync.roundtrip.package.managed import SKIPPED, SUFFIX, ManagedPackage
from rebsync.roundtrip.package.manifest import BASE_MODEL
from rebsync.roundtrip.package.record import Record
from rebsync.trees import GIT

_ALIKE = 0.5  # of the lines, as git has it


@dataclass(frozen=True, slots=True)
class Search:
    """What a search came to: the model; or else several copies; or else one that is likely."""

    model: str | None = None
    copies: tuple[str, ...] = ()
    likely: str | None = None


def search(package: ManagedPackage, record: Record) -> Search:
    """Looks through all that belongs to a package for its model."""
    shown: Callable[[str], str] = str if Path(package.root).is_absolute() else os.path.relpath
    every = [p for p in _models(package.tree) if package.holds(os.path.realpath(p))]
    same = [p for p in every if _has_text(p, record.digest)]
    named = [p for p in every if Path(p).name == record.model]
    likeness = {p: _likeness(p, package.root) for p in every} if not same else {}
    alike = [p for p in every if likeness.get(p, 0) >= _ALIKE]
    for found in ([p for p in same if p in named] or same, [p for p in alike if p in named]):
        if found:
            paths = tuple(map(shown, found))
            return Search(paths[0]) if len(paths) == 1 else Search(copies=paths)
    return Search(likely=shown(max(alike, key=lambda p: likeness[p])) if alike else None)


def is_alike(model: str, root: str) -> bool:
    """Whether a model may be what became of the one that a package was made from."""
    return _likeness(model, root) >= _ALIKE


def _likeness(model: str, root: str) -> float:
    """The part of the lines that a model and the one of last time have in common."""
    try:
        now, base = read_source(model).text, read_source(f"{root}/{BASE_MODEL}").text
    except RebsyncError:
        return 0.0
    return SequenceMatcher(None, base.splitlines(), now.splitlines(), autojunk=False).ratio()


def _models(tree: str) -> Iterator[str]:
    """The models in a directory, but for what is hidden, built, or of a repository within."""
    for folder, folders, names in os.walk(tree):
        if IGNORING & set(names) or (folder != tree and GIT in (*folders, *names)):
            folders.clear()
            continue
        folders[:] = sorted(n for n in folders if n[0] != "." and n not in SKIPPED)
        yield from (f"{folder}/{n}" for n in sorted(names) if n.endswith(SUFFIX))


def _has_text(path: str, digest: str) -> bool:
    try:
        return is_text_of(read_bytes(path), digest)
    except RebsyncError:
        return False
