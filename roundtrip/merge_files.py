"""Generated files that somebody has moved to another folder of the package."""

from __future__ import annotations

from rebsync.roundtrip.digests import Standing
from rebsync.roundtrip.recorded import Record


def moved_files(now: Standing, record: Record) -> dict[str, str]:
    """Where generated files are that are missing: the only one of that name that is new, if any."""
    new: dict[str, list[str]] = {}
    for name in now.listing.files.keys() - record.files.keys():
        new.setdefault(name.rpartition("/")[2], []).append(name)
    found = {name: new.get(name.rpartition("/")[2], []) for name in now.missing}
    return {name: paths[0] for name, paths in found.items() if len(paths) == 1}
