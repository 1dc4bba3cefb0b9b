"""Where the model of a package is."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import read_bytes
from rebsync.roundtrip.digests import is_text_of
from rebsync.roundtrip.packages import SKIPPED, SUFFIX, Kept
from rebsync.roundtrip.recorded import Record
from rebsync.trees import repository

_NEAR = ("..", ".", "../models", "../model", "models", "model")


def model_of(kept: Kept, record: Record) -> str:
    """The path of a model: where its user or the manifest says, or else near by.

    RebsyncError: it is in none of these places.
    """
    if kept.model is not None:
        return kept.model
    tried = _tried(kept.root, record)
    for path in filter(os.path.lexists, tried):
        if kept.holds(os.path.realpath(path)):
            return path
        raise _outside(kept, path)
    raise _lost(kept, record, tried)


def _outside(kept: Kept, path: str) -> RebsyncError:
    """A package may not say of a file elsewhere that this is its model."""
    from rebsync.writing import told

    where = f"the repository {kept.tree}"
    if repository(kept.tree) is None:
        where = f"{kept.tree}, and no repository is there"
    message = f"its model would be {told(path)}, which is outside of {where}"
    return RebsyncError.of(kept.root, "RS815", message, f"if that is meant, --model {path} says so")


def _tried(root: str, record: Record) -> list[str]:
    """Where a model may be, the likeliest place first."""
    start = os.path.realpath(root) if Path(root).is_symlink() else root
    places = [record.path] if record.path else [f"{folder}/{record.model}" for folder in _NEAR]
    if record.path:
        places.append(f"../{record.model}")
    whole = (os.path.join(start, place) for place in places)  # noqa: PTH118 - of many packages
    return list(dict.fromkeys(map(os.path.normpath, whole)))


def _lost(kept: Kept, record: Record, tried: list[str]) -> RebsyncError:
    message = f"the model {record.model}, from which this package was made, is not there"
    hint = f"looked for {', '.join(tried)}; say where it is with --model FILE"
    same = [path for path in _models(kept.tree) if _has_text(path, record.digest)]
    if len(same) == 1:
        shown = os.path.relpath(same[0])
        generate = f"rebsync generate --force {shown} -o {Path(kept.root).parent}"
        hint = f"{shown} has the same text: `{generate}` records that, or use --model {shown}"
    return RebsyncError.of(kept.root, "RS965", message, hint)


def _models(tree: str) -> Iterator[str]:
    for folder, folders, names in os.walk(tree):
        folders[:] = sorted(n for n in folders if n[0] != "." and n not in SKIPPED)
        yield from (f"{folder}/{n}" for n in sorted(names) if n.endswith(SUFFIX))


def _has_text(path: str, digest: str) -> bool:
    try:
        return is_text_of(read_bytes(path), digest)
    except RebsyncError:
        return False
