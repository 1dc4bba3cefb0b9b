"""Generated files that go on under another path: moved by somebody, or of a renamed class."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import SequenceMatcher
from pathlib import Path, PurePosixPath

from rebsync.files import source_below
from rebsync.roundtrip.package.record import Record
from rebsync.roundtrip.package.state import PackageState


def moved_files(now: PackageState, record: Record) -> dict[str, str]:
    """Where generated files are that are missing: the only one of that name that is new, if any."""
    new: dict[str, list[str]] = {}
    for name in now.listing.files.keys() - record.files.keys():
        new.setdefault(name.rpartition("/")[2], []).append(name)
    found = {name: new.get(name.rpartition("/")[2], []) for name in now.missing}
    return {name: paths[0] for name, paths in found.items() if len(paths) == 1}


_ALIKE = 0.5  # the share of lines that two texts of one class have in common, names apart


def renamed_files(root: str, base: Mapping[str, str], theirs: Mapping[str, str]) -> dict[str, str]:
    """Generated files of today with those that they are instead of, where these have edits.

    The class that they are of has another name now, so that the edits are to be in its new file.
    """
    gone = [p for p in sorted(base.keys() - theirs.keys()) if _is_edited(root, p, base[p])]
    come = [p for p in sorted(theirs.keys() - base.keys()) if not Path(root, p).exists()]
    found: dict[str, str] = {}
    for old in gone:
        near = [n for n in come if n not in found and _kind(n) == _kind(old)]
        alike = {n: _likeness(base[old], theirs[n]) for n in near}
        best = max(near, key=lambda n: alike[n], default=None)
        if best is not None and alike[best] >= _ALIKE:
            found[best] = old
    return found


def _is_edited(root: str, name: str, generated: str) -> bool:
    source = source_below(root, name)
    return source is not None and source.text.replace("\r\n", "\n") != generated


def _kind(name: str) -> tuple[str, str]:
    path = PurePosixPath(name)
    return str(path.parent), path.suffix


def _likeness(text: str, other: str) -> float:
    return SequenceMatcher(None, text.splitlines(), other.splitlines(), autojunk=False).ratio()
