"""Keeps between runs what was read from a text: models by the digests of what they were read from.

An entry is a file of its own, put in place in one step, so that processes do not disturb each
other. It is sealed (`rebsync.cache`), and holds nothing but values of rebsync (`serialisation`).
"""

from __future__ import annotations

import hashlib
import os
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from rebsync import __version__
from rebsync.cache import open_cache

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rebsync.source import Source

T = TypeVar("T")

_MOST = 1000  # entries; when there are more, the older half goes
# What an entry holds follows from the texts and from the code that reads these.
_READERS = (
    *("", "grammars", "reverse", "roundtrip", "static"),
    "checker",
)


def key_of(*parts: str) -> str:
    """The name of an entry: what was read, by which rebsync on which Python."""
    told = (*parts, __version__, _readers(), ".".join(map(str, sys.version_info[:2])))
    return hashlib.sha256("\0".join(told).encode("utf-8", "surrogateescape")).hexdigest()


@cache
def _readers() -> str:
    """Which state the reading code is in, told from the times and sizes of its files."""
    waiting = [str(Path(__file__).parents[3] / name) for name in _READERS]
    found = []
    for folder in waiting:  # which grows
        with suppress(OSError), os.scandir(folder) as entries:
            for entry in entries:
                if entry.name.endswith((".py", ".lark")):
                    status = entry.stat()
                    found.append(f"{entry.name} {status.st_mtime_ns} {status.st_size}")
                elif folder != waiting[0] and entry.name[0].isalpha() and entry.is_dir():
                    waiting.append(entry.path)
    return "\n".join(sorted(found))


def load(key: str, kind: type[T]) -> T | None:
    """What is kept under a key, if it is there, whole, and of the kind that is wanted."""
    cache = open_cache("values")
    text = cache.load(key) if cache is not None else None
    return decoded(text.decode("ascii"), kind) if text is not None else None


def decoded(text: str, kind: type[T], sources: Mapping[str, Source] | None = None) -> T | None:
    """The value that a text says, if it is of the kind that is wanted."""
    from rebsync.roundtrip.package.cache.serialisation import NotSerialisable, deserialised

    try:
        value = deserialised(text, sources or {})
    except NotSerialisable:
        return None  # made by a rebsync of the same version that is not quite the same
    return value if isinstance(value, kind) else None


def save(key: str, value: object) -> None:
    """Keeps a value for later runs, if that can be done."""
    cache = open_cache("values")
    if cache is None:
        return
    from rebsync.roundtrip.package.cache.serialisation import NotSerialisable, serialised

    try:
        text = serialised(value)
    except NotSerialisable:
        return
    cache.store(key, text.encode("ascii"))
    cache.tidy(_MOST)
