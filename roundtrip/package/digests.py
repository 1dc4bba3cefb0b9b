"""Digests of files, whatever their line ends and byte order marks."""

from __future__ import annotations

import hashlib

from rebsync.files import BOM


def digest_of(data: bytes) -> str:
    """The digest of a file's bytes."""
    return hashlib.sha256(data).hexdigest()


def is_text_of(data: bytes, digest: str) -> bool:
    """Whether bytes are the text that has a digest, with whatever line ends."""
    if digest_of(data) == digest:
        return True
    plain = data.removeprefix(BOM).replace(b"\r\n", b"\n")
    return plain != data and digest_of(plain) == digest
