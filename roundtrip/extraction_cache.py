"""Keeps between runs what was read from a text: models by the digests of what they were read from.

An entry is a file of its own, put in place in one step, so that processes do not disturb each
other. It begins with the digest of the rest, and nothing but values of rebsync is taken from it:
what is damaged is as good as not there. All of it may be deleted at any time.
"""

from __future__ import annotations

import hashlib
import io
import os
import pickle
import secrets
import sys
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar

from rebsync import __version__
from rebsync.cache import cache_directory, is_ours
from rebsync.source import NOWHERE, Source

T = TypeVar("T")

_MOST = 1000  # entries; when there are more, the older half goes
_DIGEST = hashlib.sha256().digest_size
_NO_SOURCES: Mapping[str, Source] = MappingProxyType({})
_BUILTINS = frozenset({"frozenset", "set", "dict", "list", "tuple"})
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
    waiting = [str(Path(__file__).parent.parent / name) for name in _READERS]
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


def kept(key: str, kind: type[T]) -> T | None:
    """What is kept under a key, if it is there, whole, and of the kind that is wanted."""
    folder = _folder()
    if folder is None:
        return None
    try:
        with (folder / key).open("rb") as file:
            if not is_ours(os.fstat(file.fileno())):
                return None
            data = file.read()
    except OSError:
        return None
    body = data[_DIGEST:]
    if hashlib.sha256(body).digest() != data[:_DIGEST]:
        return None
    return opened(body, kind)


def opened(body: bytes, kind: type[T], sources: Mapping[str, Source] = _NO_SOURCES) -> T | None:
    """The value that bytes are made from, if it is of the kind that is wanted."""
    try:
        value = unpacked(body, sources)
    except (pickle.UnpicklingError, AttributeError, ImportError, EOFError, IndexError, TypeError):
        return None  # made by a rebsync of the same version that is not quite the same
    return value if isinstance(value, kind) else None


def keep(key: str, value: object) -> None:
    """Keeps a value for later runs, if that can be done."""
    folder = _folder()
    if folder is None:
        return
    try:
        body = packed(value)
    except RecursionError:
        return
    staged = folder / f".{key}.{secrets.token_hex(4)}"
    try:
        handle = os.open(staged, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(handle, "wb") as file:
            file.write(hashlib.sha256(body).digest() + body)
        staged.replace(folder / key)
    except OSError:
        with suppress(OSError):
            staged.unlink()
    _tidy(folder)


def _folder() -> Path | None:
    base = cache_directory()
    if base is None:
        return None
    folder = base / "check"
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        return folder if is_ours(folder.stat()) else None
    except OSError:
        return None


def _tidy(folder: Path) -> None:
    """Lets the entries go that were made longest ago, when there are many."""
    with suppress(OSError):
        names = os.listdir(folder)  # noqa: PTH208
        if len(names) <= _MOST:
            return
        times = []
        for name in names:
            with suppress(OSError):
                times.append(((folder / name).stat().st_mtime_ns, name))
        for _, name in sorted(times)[: len(times) // 2]:
            with suppress(OSError):
                (folder / name).unlink()


# --- values as bytes ----------------------------------------------------------------------------


def packed(value: object, sources: Mapping[str, Source] = _NO_SOURCES) -> bytes:
    """A value of rebsync as bytes, without the texts of `sources`, which go by their paths.

    RecursionError: it is nested too deeply.
    """
    file = io.BytesIO()
    _Writer(file, sources).dump(value)
    return file.getvalue()


def unpacked(data: bytes, sources: Mapping[str, Source] = _NO_SOURCES) -> object:
    """The value that bytes are made from. pickle.UnpicklingError: not all of it is rebsync's."""
    return _Reader(io.BytesIO(data), sources).load()


class _Writer(pickle.Pickler):
    """Writes the one span that is no place by its name: it is told from others by identity.

    And texts that the reader is to have by their paths.
    """

    def __init__(self, file: io.BytesIO, sources: Mapping[str, Source]) -> None:
        super().__init__(file, protocol=5)
        self._sources = sources

    def reducer_override(self, value: object) -> Any:  # noqa: ANN401 - what pickle asks for
        return "NOWHERE" if value is NOWHERE else NotImplemented

    def persistent_id(self, value: object) -> str | None:
        """The path of a text that the reader has."""
        if isinstance(value, Source) and self._sources.get(value.path) is value:
            return value.path
        return None


class _Reader(pickle.Unpickler):
    """Makes values of rebsync's own classes only."""

    def __init__(self, file: io.BytesIO, sources: Mapping[str, Source]) -> None:
        super().__init__(file)
        self._sources = sources

    def persistent_load(self, path: object) -> Source:
        """The text of a path. pickle.UnpicklingError: there is none."""
        if isinstance(path, str) and path in self._sources:
            return self._sources[path]
        raise pickle.UnpicklingError(f"no text of {path}")

    def find_class(self, module: str, name: str) -> object:
        if (module, name) == (NOWHERE.__module__, "NOWHERE"):
            return NOWHERE
        if module.startswith("rebsync.") or (module == "builtins" and name in _BUILTINS):
            found: object = super().find_class(module, name)
            if isinstance(found, type):
                return found
        raise pickle.UnpicklingError(f"{module}.{name}")
