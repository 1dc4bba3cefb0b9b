"""A manifest of which a merge of git left both sides: what holds of the package that was merged.

Nothing in it is for people to decide. What was in step before is what git has made of both: the
base model and the base texts as they lie there, as far as these have no conflicts themselves.
"""

from __future__ import annotations

import json
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import BOM, read_bytes, read_source
from rebsync.roundtrip.package.digests import digest_of
from rebsync.roundtrip.package.manifest import BASE, BASE_MODEL, MANIFEST
from rebsync.roundtrip.package.record import Record, conflict_in, read_record, record_in
from rebsync.source import Source


def read_merged_record(root: str) -> Record:
    """The manifest of a package, put together from both sides where a merge left these.

    RebsyncError: as `read_record` has it, or the sides do not fit together.
    """
    try:
        return read_record(root)
    except RebsyncError as error:
        if error.findings[0].diagnostics[0].code != "RS966":
            raise
        merged = _merged(root, read_source(f"{root}/{MANIFEST}"))
        if merged is None:
            raise
        return merged


def _merged(root: str, source: Source) -> Record | None:
    """What both sides say together; None where one is damaged, or they do not fit together."""
    try:
        ours, theirs = (record_in(source, json.loads(side)) for side in sides_of(source.text))
    except (ValueError, RecursionError, RebsyncError):
        return None
    if (ours.model, ours.path, ours.options) != (theirs.model, theirs.path, theirs.options):
        return None
    names = sorted({*ours.files, *theirs.files})
    digests = {name: _digest(f"{root}/{BASE}{name}") for name in names}
    files = {name: digest for name, digest in digests.items() if digest}
    accepted = ours.accepted | theirs.accepted
    base = _of_base(root)
    return Record(ours.model, ours.path, base, ours.options, files, accepted, is_merged=True)


def sides_of(text: str) -> tuple[str, str]:
    """The two texts that lines between conflict markers are of; what both came from is left out."""
    sides: tuple[list[str], list[str]] = ([], [])
    within: tuple[int, ...] = (0, 1)
    for line in text.splitlines(keepends=True):
        match line[:7]:
            case "<<<<<<<":
                within = (0,)
            case "|||||||":
                within = ()
            case "=======":
                within = (1,)
            case ">>>>>>>":
                within = (0, 1)
            case _:
                for side in within:
                    sides[side].append(line)
    return "".join(sides[0]), "".join(sides[1])


def _of_base(root: str) -> str:
    """The digest of the base model, if it is a model still; empty if not."""
    from rebsync.roundtrip.package.models import parsed

    path = f"{root}/{BASE_MODEL}"
    digest = _digest(path)
    try:
        if digest:
            parsed(read_source(path))
    except RebsyncError:
        return ""
    return digest


def _digest(path: str) -> str:
    """The digest of a text, whatever its line ends; empty if it is not there, or has conflicts."""
    if not Path(path).is_file() or conflict_in(read_source(path)) is not None:
        return ""
    return digest_of(read_bytes(path).removeprefix(BOM).replace(b"\r\n", b"\n"))
