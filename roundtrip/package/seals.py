"""Seals of records that are believed: those that this user's rebsync wrote or has proved.

`.rebsync/` is committed with the code, so that a branch can make it say anything: digests of edited
code under which nothing is looked at, or base texts that an edited run-time part equals. A manifest
that was written or proved here is known again by a seal in the user's cache; any other is proved by
`rebsync.roundtrip.verdict.authenticity`.
"""

from __future__ import annotations

import os

from rebsync.cache import open_cache
from rebsync.diagnostics import RebsyncError
from rebsync.files import read_bytes
from rebsync.roundtrip.package.digests import digest_of
from rebsync.roundtrip.package.manifest import MANIFEST
from rebsync.terminal import encoded

_PART = "records"
_PLACES = "models"  # where they are that no manifest leads to
_MOST = 10_000  # seals; when there are more, the older half goes


def attest(manifest: str) -> None:
    """Notes that the text of a manifest is believed from now on."""
    cache = open_cache(_PART)
    if cache is not None:
        cache.store(digest_of(encoded(manifest)), b"")
        cache.tidy(_MOST)


def remember_model(root: str, manifest: str, model: str) -> None:
    """Notes for this user where the model is of a package whose manifest cannot say so."""
    cache = open_cache(_PLACES)
    if cache is not None:
        where = os.fsencode(os.path.realpath(model))
        cache.store(_place(root, digest_of(encoded(manifest))), where)
        cache.tidy(_MOST)


def remembered_model(root: str) -> str | None:
    """The real path of the model that a package was last written from, where that was noted."""
    cache = open_cache(_PLACES)
    if cache is None:
        return None
    try:
        digest = digest_of(read_bytes(f"{root}/{MANIFEST}"))
    except RebsyncError:
        return None
    found = cache.load(_place(root, digest))
    return os.fsdecode(found) if found is not None else None


def _place(root: str, digest: str) -> str:
    return digest_of(os.fsencode(os.path.realpath(root)) + digest.encode())


def is_attested(root: str) -> bool:
    """Whether the manifest of a package was written or proved here."""
    cache = open_cache(_PART)
    if cache is None:
        return False
    try:
        name = digest_of(read_bytes(f"{root}/{MANIFEST}"))
    except RebsyncError:
        return False
    return cache.load(name) is not None
